"use strict";
// Draws the plots of a page with uPlot from the JSON in the page (figure.rs, series.rs); plots share cursor and zoom.
// legend.js, data.js and keys.js add their controls.
{
  const FONT = '12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", sans-serif';
  const DARK = matchMedia("(prefers-color-scheme: dark)");
  const NARROW = matchMedia("(max-width: 760px)");

  // Panels that share a cursor: the key is the group name of their figures, or the figure itself.
  const groups = new Map();
  let printing = false;

  const colour = curve => curve.colours[DARK.matches && !printing ? 1 : 0];
  const style = name => getComputedStyle(document.documentElement).getPropertyValue(name);
  const column = text => new Float32Array(Uint8Array.from(atob(text), byte => byte.charCodeAt(0)).buffer);
  // Zero has no sign.
  const minus = text => text.replace(/^-(?=[0.]+$)/, "").replace("-", "−");

  // Formats a value with enough digits to resolve a thousandth of the axis range.
  function number(u, axis, value) {
    const { min, max, distr } = u.scales[axis];
    if (distr === 3 || Number.isNaN(value)) return String(Number(value.toPrecision(4)));
    const digits = Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(max - min))));
    return minus(value.toFixed(digits));
  }

  // Formats the labels of an axis with as many decimals as their spacing needs.
  function labels(u, splits, axis, space, distance) {
    let digits = 0;
    while (digits < 9 && Math.abs(distance * 10 ** digits - Math.round(distance * 10 ** digits)) > 1e-6) digits++;
    return splits.map(value => minus(value.toFixed(digits)));
  }

  // Tick marks of a logarithmic axis: tenths of each decade, or hundredths for a short axis.
  function decades(u, axis, min, max) {
    const splits = [];
    for (let power = Math.floor(Math.log10(min)); power <= Math.log10(max); power++)
      for (let part = 10; part < 100; part += max / min > 4 ? 10 : 1) splits.push(Number(`${part}e${power - 1}`));
    return splits.filter(value => value >= min && value <= max);
  }

  // Labels of a logarithmic axis: only the tick marks that have room for a label.
  function written(u, splits, axis, space) {
    const [one, ten] = [1, 10].map(value => u.valToPos(value, u.axes[axis].scale));
    const room = Math.abs(ten - one) / space;
    const shown = room > 22 ? /./ : room > 3.4 ? /^[125]e/ : /^1e/;
    return splits.map(value => (shown.test(value.toExponential()) ? value : null));
  }

  // Returns the outline and the filled area of a curve on the canvas.
  function paths(u, curve) {
    const [xs, lows, highs] = curve.columns;
    const x = index => u.valToPos(xs[index], "x", true);
    const y = value => u.valToPos(value, "y", true);
    const stroke = new Path2D();
    const fill = new Path2D();
    const last = curve.isHidden ? -1 : xs.length - 1;
    const bottom = u.bbox.top + u.bbox.height;
    if (curve.stroke === "points") {
      for (let i = 0; i <= last; i++) {
        fill.moveTo(x(i), y(lows[i]));
        fill.arc(x(i), y(lows[i]), 3.5 * devicePixelRatio, 0, 2 * Math.PI);
      }
    } else if (curve.stroke === "marks" || curve.stroke === "bars") {
      for (let i = 0; i <= last; i++) {
        stroke.moveTo(x(i), highs ? y(lows[i]) : bottom);
        stroke.lineTo(x(i), highs ? y(highs[i]) : bottom - 10 * devicePixelRatio);
      }
    } else if (curve.stroke === "band") {
      for (let i = 0; i <= last; i++) fill.lineTo(x(i), y(lows[i]));
      for (let i = last; i >= 0; i--) fill.lineTo(x(i), y(highs[i]));
    } else {
      // NaN makes a gap in the line.
      let isDown = false;
      for (let i = 0; i <= last; i++) {
        if (!Number.isNaN(lows[i])) stroke[isDown ? "lineTo" : "moveTo"](x(i), y(lows[i]));
        isDown = !Number.isNaN(lows[i]);
      }
      if (curve.stroke === "filled" && last >= 0) {
        fill.addPath(stroke);
        for (const end of [last, 0]) fill.lineTo(x(end), y(0));
      }
    }
    return { stroke, fill, clip: null, flags: 0 };
  }

  function series(curve) {
    const isSolid = curve.stroke === "points";
    return {
      auto: false, pxAlign: 0,
      width: isSolid || curve.stroke === "band" ? 0 : curve.width,
      stroke: () => colour(curve),
      fill: () => colour(curve) + (isSolid ? "" : "40"),
      dash: curve.stroke === "dashes" ? [6 * devicePixelRatio, 5 * devicePixelRatio] : undefined,
      paths: u => paths(u, curve),
      points: { show: false },
    };
  }

  const scale = axis => ({ time: false, distr: axis.decades ? 3 : 1, auto: false, range: () => axis.range });

  function axis(name, { label, decades: isDecades }) {
    return {
      scale: name,
      ...(name === "x" ? { label, labelSize: 18, labelFont: FONT } : {}),
      font: FONT,
      stroke: () => style("--soft"),
      space: name === "x" ? 56 : 34, gap: 4,
      size: (u, values) => (name === "x" ? 24 : Math.max(50, 14 + 7 * Math.max(0, ...(values ?? []).map(text => text.length)))),
      grid: { stroke: () => style("--line"), width: 1 },
      ticks: { stroke: () => style("--line"), width: 1, size: 4 },
      border: { show: true, stroke: () => style("--soft"), width: 1 },
      values: isDecades ? (u, splits) => splits.map(value => (value === null ? "" : String(Number(value.toPrecision(6))))) : labels,
      ...(isDecades ? { splits: decades, filter: written } : {}),
    };
  }

  // Finds the sample of a curve nearest to an abscissa.
  function nearest([xs], x) {
    let [from, to] = [0, xs.length - 1];
    while (to - from > 1) {
      const middle = (from + to) >> 1;
      [from, to] = xs[middle] <= x ? [middle, to] : [from, middle];
    }
    return x - xs[from] <= xs[to] - x ? from : to;
  }

  // Finds the fraction of a loop at which the curve is nearest to the mouse.
  function along(panel, left, top) {
    let [least, part] = [Infinity, 0];
    for (const { isHidden, columns: [xs, ys] } of panel.curves) {
      if (isHidden) continue;
      for (let i = 0; i < xs.length; i++) {
        const distance = Math.hypot(panel.u.valToPos(xs[i], "x") - left, panel.u.valToPos(ys[i], "y") - top);
        if (distance < least) [least, part] = [distance, i / Math.max(1, xs.length - 1)];
      }
    }
    return part;
  }

  // The cursor of histories is an abscissa. The cursor of loops is a fraction of the loop, the same for every loop.
  function point(panel, cursor) {
    panel.cursor = cursor;
    panel.shown = panel.curves.map(({ columns, stroke, isHidden }) => {
      if (!cursor || isHidden || stroke === "marks" || columns[0].length === 0) return null;
      return panel.isLoop ? Math.round(cursor.part * (columns[0].length - 1)) : nearest(columns, cursor.x);
    });
  }

  // Shows the values under the cursor.
  function tell({ u, head, x, cursor, isLoop, curves, shown }) {
    for (const item of head.querySelectorAll("li")) {
      const [index, [xs, lows, highs]] = [shown[item.dataset.curve], curves[item.dataset.curve].columns];
      const value = of => number(u, "y", of[index]);
      const text = () => (isLoop ? `${number(u, "x", xs[index])}; ${value(lows)}` : highs ? `${value(lows)} to ${value(highs)}` : value(lows));
      item.querySelector(".value").textContent = index == null ? "" : text();
    }
    const [quantity, unit] = x.label.split(/, (?=[^,]*$)/);
    head.parentElement.querySelector(".at").textContent = cursor && !isLoop ? `${quantity} ${number(u, "x", cursor.x)} ${unit ?? ""}`.trim() : "";
  }

  // Returns the other panels that share the cursor: loops of the group, or histories over the same quantity.
  function peers({ group, isLoop, x, u }) {
    return group.filter(other => other.u !== u && other.isLoop === isLoop && (isLoop || other.x.label === x.label));
  }

  function shareCursor(panel) {
    const { cursor, isLoop } = panel;
    for (const other of peers(panel)) {
      const left = !cursor ? -10 : isLoop ? 0 : other.u.valToPos(cursor.x, "x");
      const isWithin = left >= 0 && left <= other.u.over.clientWidth;
      point(other, isWithin ? cursor : null);
      other.u.setCursor(isWithin ? { left, top: 0 } : { left: -10, top: -10 });
    }
  }

  // Shows a cursor that a key has set.
  function show(panel, cursor) {
    point(panel, cursor);
    const left = !cursor ? -10 : panel.isLoop ? 0 : panel.u.valToPos(cursor.x, "x");
    panel.u.setCursor({ left, top: cursor ? 0 : -10 });
    shareCursor(panel);
  }

  // Histories zoom to the same range, where they have data.
  function shareZoom(panel) {
    if (panel.isLoop) return;
    const { min, max } = panel.u.scales.x;
    const isWhole = min === panel.x.range[0] && max === panel.x.range[1];
    for (const other of peers(panel)) {
      const [first, last] = other.x.range;
      const [from, to] = isWhole ? [first, last] : [min, max];
      const shown = other.u.scales.x;
      if (from < last && to > first && (shown.min !== from || shown.max !== to)) other.u.setScale("x", { min: from, max: to });
    }
  }

  // A plot on paper is lower than on a screen, so that two figures fit on a page.
  function size(panel) {
    const width = panel.plot.clientWidth;
    const height = NARROW.matches ? Math.min(230, panel.height) : panel.height;
    return { width, height: printing ? Math.round(Math.min(height, 250, (panel.isLoop ? 0.8 : 0.62) * width)) : height };
  }

  function options(panel) {
    // Share only changes made by the mouse, not changes received from another panel.
    const moved = (u, over, handle) => event => { panel.isMoved = true; handle(event); panel.isMoved = false; };
    const whole = u => () => ["x", "y"].forEach(name => u.setScale(name, { min: null, max: null }));
    return {
      ...size(panel),
      mode: 2, padding: [8, 16, 0, 0], legend: { show: false },
      scales: { x: scale(panel.x), y: scale(panel.y) },
      axes: [axis("x", panel.x), axis("y", panel.y)],
      series: [null, ...panel.curves.map(series)],
      cursor: {
        x: !panel.isLoop,
        y: false,
        bind: { mousemove: moved, mouseleave: moved, dblclick: whole },
        drag: { x: true, y: true, dist: 5, uni: panel.isLoop ? null : 30 },
        dataIdx: (u, number) => panel.shown[number - 1],
        points: { size: 8, width: 1.5, stroke: () => style("--paper"), fill: (u, number) => colour(panel.curves[number - 1]) },
        move(u, left, top) {
          if (panel.isMoved) point(panel, left < 0 ? null : panel.isLoop ? { part: along(panel, left, top) } : { x: u.posToVal(left, "x") });
          return [left, top];
        },
      },
      hooks: {
        setCursor: [() => { tell(panel); if (panel.isMoved) shareCursor(panel); }],
        setScale: [(u, name) => { if (name === "x") shareZoom(panel); }],
      },
    };
  }

  function paint() {
    for (const { u, curves, head } of [...groups.values()].flat()) {
      for (const key of head.querySelectorAll(".key")) key.style.color = colour(curves[key.closest("li").dataset.curve]);
      u.redraw();
    }
  }

  function draw(plot) {
    const panel = JSON.parse(plot.nextElementSibling.textContent);
    const columns = panel.columns.map(column);
    for (const curve of panel.curves) curve.columns = curve.columns.map(place => columns[place]);
    const figure = plot.closest("figure");
    const name = figure.dataset.cursorGroup ?? figure;
    panel.group = groups.get(name) ?? [];
    groups.set(name, panel.group);
    panel.plot = plot;
    panel.head = plot.previousElementSibling;
    panel.isLoop = panel.curves.some(curve => !curve.rises);
    point(panel, null);
    panel.u = new uPlot(options(panel), [null, ...panel.curves.map(curve => curve.columns)], plot);
    panel.group.push(panel);
    connectLegend(panel);
    offerNumbers(panel);
    listenToKeys(panel, cursor => show(panel, cursor));
    new ResizeObserver(() => panel.u.setSize(size(panel))).observe(plot);
  }

  document.querySelectorAll(".plot").forEach(draw);
  paint();
  DARK.addEventListener("change", paint);
  for (const event of ["beforeprint", "afterprint"])
    addEventListener(event, () => {
      printing = event === "beforeprint";
      document.documentElement.classList.toggle("print", printing);
      for (const panel of [...groups.values()].flat()) panel.u.setSize(size(panel));
      paint();
    });
}
