"use strict";
// The vehicle from behind at the chosen wheelset, on its track with the cant.
{
  const live = (globalThis.live ??= {});
  const { paint, vehicle, frames } = live;

  const HALF_M = 2.4;
  const [TOP_M, DEPTH_M] = [4.3, 0.85];
  const RAIL_M = 0.75;

  // Rails, sleeper and ballast; the origin is the middle of the track at the top of the rails, y down.
  function bed(context, pixels) {
    const { colours } = paint;
    const polygon = (points, fill) => {
      context.beginPath();
      for (const [x, y] of points) context.lineTo(x * pixels, y * pixels);
      context.closePath();
      context.fillStyle = fill;
      context.fill();
    };
    polygon(
      [
        [-1.55, 0.24],
        [1.55, 0.24],
        [1.95, 0.75],
        [-1.95, 0.75],
      ],
      colours.ballast,
    );
    polygon(
      [
        [-1.3, 0.18],
        [1.3, 0.18],
        [1.3, 0.38],
        [-1.3, 0.38],
      ],
      colours.soft,
    );
    for (const side of [-RAIL_M, RAIL_M]) {
      const at = (x, y) => [side + x, y];
      polygon(
        [
          at(-0.036, 0),
          at(0.036, 0),
          at(0.036, 0.04),
          at(0.01, 0.06),
          at(0.01, 0.14),
          at(0.075, 0.165),
          at(0.075, 0.18),
          at(-0.075, 0.18),
          at(-0.075, 0.165),
          at(-0.01, 0.14),
          at(-0.01, 0.06),
          at(-0.036, 0.04),
        ],
        colours.metal,
      );
    }
  }

  // Moves a path that is drawn about the centre of a part with that part.
  function placed(flat, pixels, height, { lateral, vertical, roll }) {
    const matrix = new DOMMatrix()
      .translate(lateral * pixels, (vertical - height) * pixels)
      .rotate((roll * 180) / Math.PI);
    const path = new Path2D();
    path.addPath(flat, matrix);
    return path;
  }

  function wheelset(pixels, set) {
    const flat = new Path2D();
    const radius = set.radius_m;
    flat.rect(-1.02 * pixels, -0.08 * pixels, 2.04 * pixels, 0.16 * pixels);
    for (const side of [-1, 1]) {
      flat.roundRect((side * RAIL_M - 0.065) * pixels, -radius * pixels, 0.13 * pixels, 2 * radius * pixels, 3);
      // The flange, on the inner side.
      flat.rect(
        (side * (RAIL_M - 0.05) - 0.016) * pixels,
        -(radius + 0.028) * pixels,
        0.032 * pixels,
        2 * (radius + 0.028) * pixels,
      );
    }
    return flat;
  }

  function box(part, pixels, radius) {
    const flat = new Path2D();
    const [bottom, top] = part.height_m.map(height => (part.centre_m[1] - height) * pixels);
    const half = part.half_width_m * pixels;
    flat.roundRect(-half, top, 2 * half, bottom - top, radius);
    return flat;
  }

  function forces(context, pixels, set) {
    for (const [side, sign] of [
      ["left", -1],
      ["right", 1],
    ]) {
      const value = suffix => frames.value(`${set.slug}_${side}${suffix}`);
      const x = sign * RAIL_M * pixels;
      const load = (value("_load_n") / 200e3) * pixels;
      // Below the rail, pointing at it: the rail carries the wheel.
      paint.arrow(context, x, 0.04 * pixels + Math.max(0, load) * 0.7, 0, -Math.max(0, load) * 0.7, side, 3);
      paint.arrow(context, x, 0, (-sign * value("_lateral_n") * pixels) / 40e3, 0, side, 3);
    }
  }

  function draw({ context, width, height }) {
    if (!live.scene) return;
    const set = live.scene.wheelsets[live.view.wheelset] ?? live.scene.wheelsets[0];
    if (!set) return;
    const frame = vehicle.frameAt(set.x_m);
    const body = vehicle.bodyAt(set.x_m);
    const pixels = Math.min(width / (2 * HALF_M), height / (TOP_M + DEPTH_M));
    const { cant } = vehicle.course(vehicle.distance() + set.x_m);
    context.save();
    context.translate(width / 2, height - DEPTH_M * pixels);
    context.save();
    // A curve to the right raises the left rail: the track turns clockwise.
    context.rotate(Math.asin(Math.max(-1, Math.min(1, cant / 1.5))));
    bed(context, pixels);
    const part = (part, run, radius) =>
      placed(box(part, pixels, radius), pixels, part.centre_m[1], vehicle.motion(part, run));
    paint.shape(context, part(body, 0, 0.3 * pixels), false, "shell", "metal", 1.5);
    windows(context, pixels, body);
    if (frame) paint.shape(context, part(frame, 0, 5), false, "ground", "metal");
    const wheels = run => placed(wheelset(pixels, set), pixels, set.radius_m, vehicle.motion(set, run));
    paint.shape(context, wheels(0), false, "paper", "ink");
    live.scene.dampers.forEach((damper, number) => {
      if (vehicle.frameAt(damper.ends_m[0][0]) !== frame) return;
      const points = vehicle.ends(damper).map(([, y, h]) => [y * pixels, -h * pixels]);
      if (damper.direction === "longitudinal") live.damperEnd(context, points[0], number);
      else live.damper(context, ...points, damper, number, pixels / 40e3);
    });
    if (frames.has(1)) {
      for (const other of [body, frame].filter(Boolean)) paint.shape(context, part(other, 1, 5), true);
      paint.shape(context, wheels(1), true);
    }
    forces(context, pixels, set);
    context.restore();
    paint.text(context, "left", -RAIL_M * pixels, 0.8 * pixels, { align: "center", colour: "left", weight: 600 });
    paint.text(context, "right", RAIL_M * pixels, 0.8 * pixels, { align: "center", colour: "right", weight: 600 });
    context.restore();
  }

  function windows(context, pixels, body) {
    const flat = new Path2D();
    const top = (body.centre_m[1] - body.height_m[1]) * pixels;
    for (const side of [-1, 0.12])
      flat.roundRect(side * 0.95 * pixels, top + 0.42 * pixels, 0.83 * pixels, 0.7 * pixels, 4);
    context.globalAlpha = 0.35;
    context.fillStyle = paint.colours.metal;
    context.fill(placed(flat, pixels, body.centre_m[1], vehicle.motion(body, 0)));
    context.globalAlpha = 1;
  }

  live.drawBehind = () =>
    paint.view("behind", {
      height: width => Math.min(380, (width / (2 * HALF_M)) * (TOP_M + DEPTH_M)),
      draw,
      period_ms: 32,
    });
}
