"use strict";
// Dampers and wheelsets are chosen by a click on them in a drawing; the lists do the same for the keyboard.
{
  const live = (globalThis.live ??= {});

  const REACH_PX = 26;
  const places = new Map();

  // Forgets the places of a drawing before it is drawn again.
  const clear = canvas => places.set(canvas, []);
  // Notes where a drawing shows something: `choice` is {damper} or {wheelset}, and how far it reaches.
  const note = (context, [x, y], choice) => places.get(context.canvas)?.push({ x, y, ...choice });

  function nearest(event) {
    let [found, least] = [null, Infinity];
    for (const place of places.get(event.currentTarget) ?? []) {
      const distance = Math.hypot(place.x - event.offsetX, place.y - event.offsetY);
      if (distance < Math.min(least, place.reach ?? REACH_PX)) [found, least] = [place, distance];
    }
    return found;
  }

  function choose(event) {
    const found = nearest(event);
    if (found?.damper !== undefined) live.dampers.choose([found.damper]);
    else if (found) live.dampers.chooseWheelset(found.wheelset);
  }

  function start() {
    for (const id of ["side", "above", "slots"]) {
      const canvas = document.getElementById(id);
      canvas.addEventListener("click", choose);
      canvas.addEventListener("pointermove", event => (canvas.style.cursor = nearest(event) ? "pointer" : ""));
    }
  }

  Object.assign(live, { pick: { start, clear, note } });
}
