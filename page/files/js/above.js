"use strict";
// The vehicle from above, with the curve of the track, and below it the course for the next hundreds of metres.
{
  const live = (globalThis.live ??= {});
  const { paint, vehicle, frames } = live;

  const HALF_M = 2.4;
  const COURSE_PX = 46;
  const NARROW_PX = 440;
  const [BEHIND_M, AHEAD_M] = [60, 300];
  // Half the distance between the middles of the rails.
  const RAIL_M = 0.75;

  // Lateral offset of the track at x from the tangent at the middle of the vehicle: double integral of the curvature.
  function bend(at) {
    const step = 0.5;
    const offsets = new Map([[0, [0, 0]]]);
    for (const way of [1, -1]) {
      let [offset, heading] = [0, 0];
      for (let n = 1; n * step < 30; n++) {
        const { curvature } = vehicle.course(at + way * (n - 0.5) * step);
        offset += way * heading * step + 0.5 * curvature * step * step;
        heading += way * curvature * step;
        offsets.set(way * n, [offset, heading]);
      }
    }
    return x => {
      const n = Math.trunc(x / step);
      const [offset, heading] = offsets.get(n) ?? [0, 0];
      return [offset + heading * (x - n * step), heading];
    };
  }

  function track(context, sheet, y, bent, at, width) {
    const { colours } = paint;
    const { pixels, rear, front } = sheet;
    const along = (offset, draw) => {
      context.beginPath();
      for (let x = rear; x <= front + 0.5; x += 0.5) {
        const [middle] = bent(x);
        draw(sheet.x(x), y(middle + offset));
      }
    };
    const to = (x, at) => context.lineTo(x, at);
    along(0, to);
    context.strokeStyle = colours.ballast;
    context.lineWidth = 3.1 * pixels;
    context.stroke();
    const still = paint.isStill() ? 0 : at;
    const sharp = paint.sharpness(0.6, vehicle.speed());
    if (sharp > 0.02) {
      context.globalAlpha = 0.35 * sharp;
      for (let n = Math.ceil((still + rear) / 0.6); n * 0.6 < still + front; n++) {
        const x = n * 0.6 - still;
        const [middle] = bent(x);
        paint.line(context, sheet.x(x), y(middle - 1.3), sheet.x(x), y(middle + 1.3), "soft", 0.24 * pixels);
      }
      context.globalAlpha = 1;
    }
    for (const side of [-RAIL_M, RAIL_M]) {
      along(side, to);
      context.strokeStyle = colours.metal;
      context.lineWidth = Math.max(2, 0.07 * pixels);
      context.stroke();
    }
    for (const { at_m, label } of live.defects ?? []) {
      if (at_m - at < rear || at_m - at > front) continue;
      paint.line(context, sheet.x(at_m - at), y(-1.5), sheet.x(at_m - at), y(1.5), "over", 2, [4, 3]);
      if (sheet.pixels > 24)
        paint.text(context, label, sheet.x(at_m - at), y(1.5) + 12, { colour: "over", size: 11.5, align: "center" });
    }
  }

  // Path of a rectangle [x0, x1] by half a width around a part, moved and turned with it.
  function plate(sheet, y, bent, centre, motion, [x0, x1], half, radius) {
    const [middle, heading] = bent(centre);
    const { pixels } = sheet;
    const flat = new Path2D();
    flat.roundRect((x0 - centre) * pixels, -half * pixels, (x1 - x0) * pixels, 2 * half * pixels, radius);
    const matrix = new DOMMatrix()
      .translate(sheet.x(centre), y(middle + motion.lateral))
      .rotate(((heading + motion.yaw) * 180) / Math.PI);
    const path = new Path2D();
    path.addPath(flat, matrix);
    return path;
  }

  function wheelset(context, sheet, y, bent, set, number, run) {
    const motion = vehicle.motion(set, run);
    const of = (box, half, radius) =>
      plate(sheet, y, bent, set.x_m, motion, [set.x_m + box[0], set.x_m + box[1]], half, radius);
    const [middle, heading] = bent(set.x_m);
    const turn = heading + motion.yaw;
    const isChosen = live.view.wheelset === number;
    paint.shape(context, of([-0.08, 0.08], 0.98, 2), run === 1, "metal", "metal");
    for (const side of [-1, 1]) {
      const flat = new Path2D();
      const { pixels } = sheet;
      flat.roundRect(
        -set.radius_m * pixels,
        (side * RAIL_M - 0.07) * pixels,
        2 * set.radius_m * pixels,
        0.14 * pixels,
        2,
      );
      const path = new Path2D();
      path.addPath(
        flat,
        new DOMMatrix().translate(sheet.x(set.x_m), y(middle + motion.lateral)).rotate((turn * 180) / Math.PI),
      );
      paint.shape(context, path, run === 1, isChosen ? "accent" : "paper", isChosen ? "accent" : "ink");
    }
    if (run === 1) return;
    live.pick.note(context, [sheet.x(set.x_m), y(middle + motion.lateral)], { wheelset: number });
    // Force of the rails on the wheels across the track.
    const push = frames.value(set.slug + "_right_lateral_n") * -1 + frames.value(set.slug + "_left_lateral_n");
    paint.arrow(
      context,
      sheet.x(set.x_m),
      y(middle + motion.lateral),
      0,
      (push / live.side.FORCE_PER_M) * 0.5 * sheet.pixels,
      "ink",
    );
  }

  function strip(context, width, top, at) {
    const x = distance => ((distance - at + BEHIND_M) / (BEHIND_M + AHEAD_M)) * width;
    const base = top + 24;
    const scale = 13 / Math.max(1 / 600, ...(live.scene.course ?? []).map(([, curvature]) => Math.abs(curvature)));
    const places = [at - BEHIND_M, ...(live.scene.course ?? []).map(([place]) => place), at + AHEAD_M];
    const seen = places.filter(place => place >= at - BEHIND_M && place <= at + AHEAD_M).sort((a, b) => a - b);
    paint.line(context, 0, base, width, base, "line");
    context.beginPath();
    for (const place of seen) context.lineTo(x(place), base + scale * vehicle.course(place).curvature);
    context.strokeStyle = paint.colours.soft;
    context.lineWidth = 2;
    context.stroke();
    for (const { at_m } of live.defects ?? [])
      paint.text(context, "▼", x(at_m), base - 4, { colour: "over", size: 11, align: "center" });
    const [rear, front] = [x(at - 9), x(at + 9)];
    context.fillStyle = paint.colours.accent;
    context.fillRect(rear, base - 3, front - rear, 6);
    const words = `${live.words.capital(vehicle.courseInWords(at))}`;
    paint.text(context, words, 8, top + 11, { size: 11.5 });
    // Not where there is room for one of them only.
    const isWide = width > NARROW_PX;
    if (isWide) paint.text(context, `the next ${AHEAD_M} m →`, width - 8, top + 11, { size: 11.5, align: "right" });
  }

  function draw({ context, width, height }) {
    if (!live.scene) return;
    live.pick.clear(context.canvas);
    const sheet = live.side.scale(width);
    const at = vehicle.distance();
    const bent = bend(at);
    const y = lateral => (lateral + HALF_M) * sheet.pixels;
    context.save();
    context.beginPath();
    context.rect(0, 0, width, height - COURSE_PX);
    context.clip();
    track(context, sheet, y, bent, at, width);
    const part = (body, run) =>
      plate(
        sheet,
        y,
        bent,
        body.centre_m[0],
        vehicle.motion(body, run),
        body.x_m,
        body.half_width_m,
        body.kind === "body" ? 0.35 * sheet.pixels : 4,
      );
    for (const body of live.scene.bodies.filter(body => body.kind === "frame")) {
      context.globalAlpha = 0.75;
      paint.shape(context, part(body, 0), false, "ground", "metal");
      context.globalAlpha = 1;
    }
    live.scene.wheelsets.forEach((set, number) => wheelset(context, sheet, y, bent, set, number, 0));
    for (const body of live.scene.bodies.filter(body => body.kind === "body")) {
      const path = part(body, 0);
      context.globalAlpha = 0.4;
      paint.shape(context, path, false, "shell", "metal");
      context.globalAlpha = 1;
      paint.shape(context, path, false, null, "metal", 1.5);
    }
    live.scene.dampers.forEach((damper, number) => {
      const points = vehicle.ends(damper).map(([x, lateral, , centre]) => {
        const [middle, heading] = bent(centre);
        return [sheet.x(x), y(lateral + middle + heading * (x - centre))];
      });
      if (damper.direction === "vertical")
        live.damperEnd(context, points[0], number, Math.max(2.5, Math.min(5, 0.13 * sheet.pixels)));
      else live.damper(context, ...points, damper, number, sheet.pixels / live.side.FORCE_PER_M);
    });
    if (frames.has(1)) {
      for (const body of live.scene.bodies) paint.shape(context, part(body, 1), true);
      live.scene.wheelsets.forEach((set, number) => wheelset(context, sheet, y, bent, set, number, 1));
    }
    context.restore();
    strip(context, width, height - COURSE_PX, at);
  }

  live.drawAbove = () =>
    paint.view("above", {
      height: width => live.side.scale(width).pixels * 2 * HALF_M + COURSE_PX,
      draw,
      period_ms: 32,
    });
}
