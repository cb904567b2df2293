"use strict";
// All dampers of a target beside each other: small loops of force over displacement, with those of the model behind.
{
  const live = (globalThis.live ??= {});
  const { paint, words } = live;

  const [CELL_PX, ROW_PX, GAP_PX] = [170, 132, 8];
  // Names above a loop, and the sizes of its axes below it.
  const [HEAD_PX, FOOT_PX] = [18, 18];

  // Axes by the slug of a damper.
  const ranges = new Map();

  const count = () => live.scene?.dampers.length ?? 0;
  const columns = width => Math.max(1, Math.min(count(), Math.floor(width / CELL_PX)));
  const height = width => Math.ceil(count() / columns(width)) * (ROW_PX + GAP_PX);

  function cell(context, damper, number, [x, y, width]) {
    const isChosen = live.view.dampers.includes(number);
    const [left, top, tall] = [x, y + HEAD_PX, ROW_PX - HEAD_PX - FOOT_PX];
    const [middle, level] = [left + width / 2, top + tall / 2];
    live.pick.note(context, [middle, level], { damper: number, reach: width / 2 });
    const range = ranges.get(damper.slug) ?? { x: 0, y: 0 };
    ranges.set(damper.slug, range);
    const shown = live.loops.of(damper);
    live.loops.fit(range, shown);
    paint.text(context, words.capital(damper.name), left, y + 12, {
      colour: isChosen ? "accent" : "ink",
      size: 12.5,
      weight: 600,
    });
    context.strokeStyle = paint.colours[isChosen ? "accent" : "line"];
    context.lineWidth = isChosen ? 2 : 1;
    context.strokeRect(left + 1, top, width - 2, tall);
    paint.line(context, left + 1, level, left + width - 1, level, "line");
    paint.line(context, middle, top, middle, top + tall, "line");
    const px = value => middle + 0.47 * width * (value / range.x);
    const py = value => level - 0.47 * tall * (value / range.y);
    for (const one of shown) live.loops.loop(context, one, px, py);
    const axes = `±${words.short(1e3 * range.x)} mm, ±${words.short(1e-3 * range.y)} kN`;
    paint.text(context, axes, middle, y + ROW_PX - 4, { size: 11.5, align: "center" });
  }

  function draw({ context, width }) {
    if (!live.scene || !live.histories) return;
    live.pick.clear(context.canvas);
    const wide = columns(width);
    const size = (width - GAP_PX * (wide - 1)) / wide;
    live.scene.dampers.forEach((damper, number) => {
      const [column, row] = [number % wide, Math.floor(number / wide)];
      cell(context, damper, number, [column * (size + GAP_PX), row * (ROW_PX + GAP_PX), size]);
    });
  }

  live.drawSlots = () => paint.view("slots", { height, draw, period_ms: 128 });
}
