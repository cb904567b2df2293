"use strict";
// Both wheels of the chosen wheelset on their rails, from the profiles, with the forces on the wheels.
{
  const live = (globalThis.live ??= {});
  const { paint, words } = live;
  const { value, reading } = live.frames;

  const [HEIGHT_PX, HEAD_PX, FOOT_PX] = [300, 28, 46];
  // Shown part of the profiles, m from the tread datum, and the depth of the top of the rail in it.
  const [INNER_M, OUTER_M] = [-0.082, 0.072];
  const FORCE_PER_PX = 1900;
  // Steps of the shift of a wheel on its rail, and how many are looked at to each side.
  const [STEP_M, SHIFTS] = [0.0004, 32];

  let table = null;

  // Depths of a profile (m) at the multiples of a step; Infinity beside the profile.
  function grid(points) {
    const sorted = [...points].sort((a, b) => a[0] - b[0]);
    const depths = new Map();
    for (let n = 1; n < sorted.length; n++) {
      const [[y0, z0], [y1, z1]] = [sorted[n - 1], sorted[n]];
      for (let at = Math.ceil(y0 / STEP_M); at * STEP_M <= y1; at++)
        depths.set(at, z0 + ((at * STEP_M - y0) / (y1 - y0 || 1)) * (z1 - z0));
    }
    return depths;
  }

  // Profiles of a scene are measured from the middle of the track, contacts from the tread datum of the wheel.
  function fromDatum({ wheel_m, rail_m, datum_offset_m: offset = 0 }) {
    const moved = points => points.map(([y, z]) => [y - offset, z]);
    return { wheel_m: moved(wheel_m), rail_m: moved(rail_m) };
  }

  // For each outward shift of a wheel: how far it sinks until it touches, and where.
  function touching({ wheel_m, rail_m }) {
    const [rail, wheel] = [rail_m, wheel_m].map(grid);
    const rows = [];
    for (let shift = -SHIFTS; shift <= SHIFTS; shift++) {
      let [sink, place] = [Infinity, 0];
      for (const [y, z] of wheel) {
        const gap = (rail.get(y + shift) ?? Infinity) - z;
        if (gap < sink) [sink, place] = [gap, y];
      }
      rows.push({ shift: shift * STEP_M, sink: Number.isFinite(sink) ? sink : 0, place: place * STEP_M });
    }
    return { rows, wheel, wheel_m, rail_m };
  }

  // The rails deviate from their course by unknown amounts, so the wheel is put where its contact is.
  function placing(shift, contact) {
    let [best, least] = [table.rows[0], Infinity];
    for (const row of table.rows) {
      const error = (contact === null ? 0 : (row.place - contact) ** 2) + 0.02 * (row.shift - shift) ** 2;
      if (error < least) [best, least] = [row, error];
    }
    return best;
  }

  function profile(points, scale, mirror, [dy, dz], close) {
    const path = new Path2D();
    for (const [y, z] of points) path.lineTo(mirror * (y + dy) * scale, (z + dz) * scale);
    for (const [y, z] of close) path.lineTo(mirror * (y + dy) * scale, z * scale);
    path.closePath();
    return path;
  }

  function wheel(context, side, box, set, run) {
    const mirror = side === "right" ? 1 : -1;
    const of = suffix => reading(`${set.slug}_${side}${suffix}`, run);
    const [load, lateral, ratio, contact] = ["_load_n", "_lateral_n", "_derailment", "_contact_m"].map(of);
    const scale = box.width / (OUTER_M - INNER_M);
    const { wheel_m, rail_m } = table;
    const isLifted = live.frames.has(run) && load <= 0;
    // Without a known contact the wheel is where its wheelset is.
    const isKnown = Number.isFinite(contact) && Number.isFinite(load);
    const row = placing(mirror * value(set.slug + "_lateral_m", run), isLifted ? 0 : isKnown ? contact : null);
    const at = [row.shift, row.sink - (isLifted ? 0.003 : 0)];
    context.save();
    context.beginPath();
    context.rect(box.x, HEAD_PX, box.width, HEIGHT_PX - HEAD_PX - FOOT_PX);
    context.clip();
    context.translate(box.x + (mirror > 0 ? -INNER_M : OUTER_M) * scale, box.top);
    const [inner, outer] = [wheel_m[0][0], wheel_m[wheel_m.length - 1][0]];
    const rim = profile(wheel_m, scale, mirror, at, [
      [outer, -0.2],
      [inner, -0.2],
    ]);
    if (run === 0) {
      const bottom = rail_m[rail_m.length - 1][1];
      const rail = profile(
        rail_m,
        scale,
        mirror,
        [0, 0],
        [
          [rail_m[rail_m.length - 1][0], bottom + 0.06],
          [rail_m[0][0], bottom + 0.06],
        ],
      );
      paint.shape(context, rail, false, "ballast", "metal", 1.5);
      paint.shape(context, rim, false, "shell", "ink", 1.5);
    } else {
      paint.shape(context, rim, true);
    }
    if (run === 0 && !isLifted && isKnown) arrows(context, mirror, scale, at, contact, { load, lateral, side });
    context.restore();
    if (run === 0) labels(context, box, { side, load, lateral, ratio, isLifted });
  }

  function arrows(context, mirror, scale, at, contact, { load, lateral, side }) {
    const inWheel = table.wheel.get(Math.round(contact / STEP_M));
    const [x, y] = [mirror * (contact + at[0]) * scale, ((inWheel ?? 0) + at[1]) * scale];
    // Nadal: the lateral force at which this load would no longer hold the wheel down.
    const limit = (-mirror * live.scene.derailment_limit * load) / FORCE_PER_PX;
    paint.line(context, x, y, x + limit, y, "over", 1, [3, 3]);
    paint.line(context, x + limit, y - 8, x + limit, y + 8, "over", 2.5);
    paint.arrow(context, x, y, 0, -load / FORCE_PER_PX, side, 3);
    paint.arrow(context, x, y, (-mirror * lateral) / FORCE_PER_PX, 0, side, 4);
    context.beginPath();
    context.arc(x, y, 4.5, 0, 7);
    context.fillStyle = paint.colours[side];
    context.fill();
    context.strokeStyle = paint.colours.paper;
    context.lineWidth = 1.5;
    context.stroke();
  }

  function labels(context, box, { side, load, lateral, ratio, isLifted }) {
    const rows = [
      ["Q", words.quantity(load, "N", 0)],
      ["Y", words.quantity(lateral, "N", 1)],
      ["Y/Q", words.fixed(ratio, 2)],
    ];
    const x = box.x + 8;
    paint.text(context, isLifted ? `${side} wheel: lifted` : `${side} wheel`, x, 17, {
      colour: isLifted ? "over" : side,
      weight: 600,
      size: 13,
    });
    rows.forEach(([name, number], index) => {
      const at = x + index * Math.min(92, box.width / 2.9);
      paint.text(context, name, at, HEIGHT_PX - 24, { size: 11.5 });
      paint.text(context, number, at, HEIGHT_PX - 8, { colour: "ink", weight: 600, size: box.width < 200 ? 12 : 13 });
    });
  }

  function draw({ context, width }) {
    if (!live.scene?.profiles || table?.of !== live.scene.profiles) return;
    const set = live.scene.wheelsets[live.view.wheelset] ?? live.scene.wheelsets[0];
    if (!set) return;
    const half = (width - 16) / 2;
    for (const [side, x] of [
      ["left", 0],
      ["right", half + 16],
    ])
      for (const run of live.frames.has(1) ? [0, 1] : [0]) wheel(context, side, { x, width: half, top: 150 }, set, run);
    paint.line(context, width / 2, HEAD_PX, width / 2, HEIGHT_PX - FOOT_PX - 18, "line", 1, [2, 4]);
    paint.text(context, "middle of the track", width / 2, HEIGHT_PX - FOOT_PX - 6, { align: "center", size: 11 });
  }

  // Not while drawing, because it takes some milliseconds.
  live.prepareContact = () => {
    const { profiles } = live.scene;
    if (profiles) table = Object.assign(touching(fromDatum(profiles)), { of: profiles });
  };
  live.drawContact = () => paint.view("contact", { height: () => HEIGHT_PX, draw, period_ms: 48 });
}
