"use strict";
// What all drawings share: colours of the theme, canvases that fit their place, arrows, and whose turn it is to draw.
{
  const live = (globalThis.live ??= {});

  const DARK = matchMedia("(prefers-color-scheme: dark)");
  const STILL = matchMedia("(prefers-reduced-motion: reduce)");
  const NAMES = [
    "paper",
    "ground",
    "ink",
    "soft",
    "line",
    "accent",
    "left",
    "right",
    "force",
    "ghost",
    "metal",
    "shell",
    "ballast",
    "within",
    "near",
    "over",
    "worn",
    "series-1",
    "series-2",
    "series-3",
    "series-4",
    "series-5",
    "series-6",
  ];
  const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", sans-serif';

  const colours = {};
  const views = [];

  function readColours() {
    const style = getComputedStyle(document.documentElement);
    for (const name of NAMES) colours[name] = style.getPropertyValue("--" + name).trim();
    for (const view of views) view.isStale = true;
  }

  // Lets `draw(surface)` paint a canvas at most once in `period_ms`. `height(width)` is its height in pixels.
  function view(id, { height, draw, period_ms = 0, group = null }) {
    const canvas = document.getElementById(id);
    const surface = {
      canvas,
      context: canvas.getContext("2d"),
      width: 0,
      height: 0,
      isSeen: true,
      isStale: true,
      drawn: 0,
      period_ms,
      group,
    };
    // The width comes from the observer, because asking the page for it would force a layout.
    surface.fit = (width = surface.width) => {
      // A canvas that is not shown has no width.
      surface.width = width;
      if (width === 0) return;
      const ratio = Math.min(2, devicePixelRatio || 1);
      Object.assign(surface, { width, height: Math.round(height(width)), ratio, isStale: true });
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(surface.height * ratio);
      canvas.style.height = `${surface.height}px`;
    };
    surface.paint = () => {
      if (surface.width === 0) return;
      const { context, ratio } = surface;
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.clearRect(0, 0, surface.width, surface.height);
      draw(surface);
      surface.isStale = false;
    };
    new ResizeObserver(([{ contentRect }]) => surface.fit(Math.round(contentRect.width))).observe(canvas.parentElement);
    new IntersectionObserver(([entry]) => (surface.isSeen = entry.isIntersecting), { rootMargin: "80px" }).observe(
      canvas,
    );
    views.push(surface);
    return surface;
  }

  const font = (context, size, weight = 400) => (context.font = `${weight} ${size}px ${FONT}`);

  function text(context, words, x, y, { colour = "soft", size = 12, weight = 400, align = "left" } = {}) {
    font(context, size, weight);
    context.textAlign = align;
    context.fillStyle = colours[colour] ?? colour;
    context.fillText(words, x, y);
  }

  // An arrow from a point, with a head that shrinks with it. Nothing for less than a pixel.
  function arrow(context, x, y, dx, dy, colour, width = 2.5) {
    const length = Math.hypot(dx, dy);
    if (!(length > 1)) return;
    const head = Math.min(3.4 * width, 0.6 * length);
    const [ux, uy] = [dx / length, dy / length];
    const [bx, by] = [x + dx - ux * head, y + dy - uy * head];
    context.strokeStyle = context.fillStyle = colours[colour] ?? colour;
    context.lineWidth = width;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(bx, by);
    context.stroke();
    context.beginPath();
    context.moveTo(x + dx, y + dy);
    context.lineTo(bx - uy * head * 0.5, by + ux * head * 0.5);
    context.lineTo(bx + uy * head * 0.5, by - ux * head * 0.5);
    context.fill();
  }

  function line(context, x1, y1, x2, y2, colour, width = 1, dash = []) {
    context.strokeStyle = colours[colour] ?? colour;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.beginPath();
    context.moveTo(x1, y1);
    context.lineTo(x2, y2);
    context.stroke();
    if (dash.length > 0) context.setLineDash([]);
  }

  // A shape that is filled, or only outlined with dashes if it belongs to the vehicle as new.
  function shape(context, path, isGhost, fill, stroke, width = 1.25) {
    if (!isGhost && fill) {
      context.fillStyle = colours[fill] ?? fill;
      context.fill(path);
    }
    context.strokeStyle = isGhost ? colours.ghost : (colours[stroke] ?? stroke);
    context.lineWidth = isGhost ? 1.5 : width;
    if (isGhost) context.setLineDash([5, 4]);
    context.stroke(path);
    if (isGhost) context.setLineDash([]);
  }

  // Marks that pass faster than the screen shows them would flicker or seem to run backwards, so they fade.
  function sharpness(spacing_m, speed_m_per_s) {
    const part = (speed_m_per_s * Math.min(1, live.status?.factor ?? 1)) / 60 / spacing_m;
    return STILL.matches ? 1 : Math.max(0, Math.min(1, 1.4 - 3 * part));
  }

  readColours();
  DARK.addEventListener("change", readColours);

  const isStill = () => STILL.matches;
  const refresh = () => views.forEach(view => (view.isStale = true));
  Object.assign(live, { paint: { colours, views, view, text, arrow, line, shape, sharpness, isStill, refresh } });
}
