"use strict";
// Keys of a plot that has the focus: arrows, Home and End move the cursor, + and - zoom, Escape shows everything again.
// `show` shows a cursor, as the mouse does.
const listenToKeys = (panel, show) => {
  const { isLoop, plot, u } = panel;
  const axes = isLoop ? ["x", "y"] : ["x"];
  const forth = name => (panel[name].decades ? Math.log : Number);
  const back = name => (panel[name].decades ? Math.exp : Number);
  const visible = name => [u.scales[name].min, u.scales[name].max];

  // Shows a part of an axis, at most the whole; `from` and `to` are on its scale, after the logarithm if it has one.
  function showPart(name, from, to) {
    const [first, last] = panel[name].range.map(forth(name));
    const width = Math.min(to - from, last - first);
    const start = Math.min(Math.max(from, first), last - width);
    const isWhole = width >= last - first;
    u.setScale(name, isWhole ? { min: null, max: null } : { min: back(name)(start), max: back(name)(start + width) });
  }

  // Shows the cursor after the axes of all plots have changed, which takes until the next frame.
  function showLater(cursor) {
    panel.cursor = cursor;
    if (cursor) requestAnimationFrame(() => show(cursor));
  }

  // Place of the cursor on an axis, or the middle of the axis.
  function centre(name) {
    const [min, max] = visible(name).map(forth(name));
    const index = panel.shown[0];
    const value = !panel.cursor ? NaN : !isLoop ? panel.cursor.x : panel.curves[0].columns[name === "x" ? 0 : 1][index];
    const place = forth(name)(value);
    return place >= min && place <= max ? place : (min + max) / 2;
  }

  function zoom(factor) {
    for (const name of axes) {
      const [min, max] = visible(name).map(forth(name));
      const middle = centre(name);
      showPart(name, middle - (middle - min) * factor, middle + (max - middle) * factor);
    }
    showLater(panel.cursor);
  }

  // Moves the cursor of a history to a place, and the visible part of the axis with it.
  function to(place) {
    const [first, last] = panel.x.range.map(forth("x"));
    const at = Math.min(Math.max(place, first), last);
    const [min, max] = visible("x").map(forth("x"));
    if (at < min) showPart("x", at, at + max - min);
    if (at > max) showPart("x", at - (max - min), at);
    showLater({ x: back("x")(at) });
  }

  function move(steps) {
    if (isLoop) return show({ part: ((panel.cursor?.part ?? 0) + steps / 200 + 1) % 1 });
    const [min, max] = visible("x").map(forth("x"));
    to(panel.cursor ? forth("x")(panel.cursor.x) + (steps * (max - min)) / 200 : (min + max) / 2);
  }

  const end = side => (isLoop ? show({ part: side }) : to(forth("x")(panel.x.range[side])));

  function whole() {
    for (const name of axes) u.setScale(name, { min: null, max: null });
    showLater(panel.cursor);
  }

  const actions = {
    ArrowLeft: event => move(event.shiftKey ? -20 : -1),
    ArrowRight: event => move(event.shiftKey ? 20 : 1),
    Home: () => end(0),
    End: () => end(1),
    "+": () => zoom(0.5),
    "=": () => zoom(0.5),
    "-": () => zoom(2),
    Escape: whole,
  };
  plot.addEventListener("keydown", event => {
    const action = actions[event.key];
    if (!action || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    // A screen reader says the values that follow the keys; with the mouse they would change too fast.
    panel.head.ariaLive = "polite";
    action(event);
  });
  plot.addEventListener("blur", () => {
    panel.head.ariaLive = "off";
    show(null);
  });
};
