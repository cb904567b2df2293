"use strict";
// The vehicle from its right side, running to the right.
{
  const live = (globalThis.live ??= {});
  const { paint, vehicle, frames } = live;

  const SKY_M = 4.35;
  const DEPTH_M = 1.25;
  // Room for the key above the vehicle and for the distances below it.
  const [KEY_PX, FOOT_PX] = [20, 20];
  const MARGIN_M = 1.7;
  // Newtons that a metre of arrow stands for in the drawings of the vehicle.
  const FORCE_PER_M = 20e3;
  const LOAD_PER_M = 150e3;

  // Scale that the views from the side and from above share, so that they align.
  function scale(width) {
    const positions = (live.scene?.bodies ?? []).flatMap(body => body.x_m);
    const [rear, front] = [Math.min(-9, ...positions) - MARGIN_M, Math.max(9, ...positions) + MARGIN_M];
    const pixels = width / (front - rear);
    return { pixels, rear, front, x: x_m => (x_m - rear) * pixels };
  }

  function ground(context, sheet, y, width) {
    const { colours } = paint;
    const { pixels, rear, front } = sheet;
    const at = vehicle.distance();
    const speed = vehicle.speed();
    context.fillStyle = colours.ballast;
    context.fillRect(0, y(-0.17), width, 0.36 * pixels);
    const still = paint.isStill() ? 0 : at;
    const marks = (spacing, draw) => {
      for (let n = Math.ceil((still + rear) / spacing); n * spacing < still + front; n++)
        draw(n * spacing - still, n * spacing);
    };
    context.globalAlpha = 0.7 * paint.sharpness(0.6, speed);
    context.fillStyle = colours.soft;
    if (context.globalAlpha > 0.02)
      marks(0.6, x => context.fillRect(sheet.x(x - 0.11), y(-0.17), 0.22 * pixels, Math.max(2, 0.1 * pixels)));
    context.globalAlpha = 1;
    paint.line(context, 0, y(-0.085), width, y(-0.085), "metal", Math.max(2.5, 0.17 * pixels));
    paint.line(context, 0, y(0), width, y(0), "ink", 1);
    marks(5, (x, place) => {
      paint.line(context, sheet.x(x), y(-0.53), sheet.x(x), y(-1.25) + 2, "line");
      if (!paint.isStill())
        paint.text(context, `${Math.round(place)} m`, sheet.x(x), y(-1.25) + 14, { align: "center", size: 11 });
    });
    for (const { at_m, label } of live.defects ?? []) {
      if (at_m - at < rear || at_m - at > front) continue;
      const x = sheet.x(at_m - at);
      paint.text(context, "▼", x, y(0.06), { colour: "over", size: 13, align: "center" });
      paint.text(context, label, x, y(0.06) - 14, { colour: "over", size: 11.5, align: "center", weight: 600 });
    }
  }

  function wheel(context, sheet, y, wheelset, number, run) {
    const { colours } = paint;
    const [cx, cy] = [sheet.x(wheelset.x_m), y(wheelset.radius_m - vehicle.motion(wheelset, run).vertical)];
    const radius = wheelset.radius_m * sheet.pixels;
    const circle = new Path2D();
    circle.arc(cx, cy, radius, 0, 7);
    paint.shape(context, circle, run === 1, "paper", "metal", Math.max(2, 0.09 * sheet.pixels));
    if (run === 1) return;
    live.pick.note(context, [cx, cy], { wheelset: number });
    context.globalAlpha = paint.sharpness(0.8, vehicle.speed());
    if (context.globalAlpha > 0.02) {
      const angle = paint.isStill() ? 0 : vehicle.distance() / wheelset.radius_m;
      for (let spoke = 0; spoke < 3; spoke++) {
        const [sin, cos] = [Math.sin(angle + (spoke * Math.PI) / 3), Math.cos(angle + (spoke * Math.PI) / 3)];
        paint.line(
          context,
          cx - cos * radius * 0.8,
          cy - sin * radius * 0.8,
          cx + cos * radius * 0.8,
          cy + sin * radius * 0.8,
          "line",
          2,
        );
      }
    }
    context.globalAlpha = 1;
    const isChosen = live.view.wheelset === number;
    context.fillStyle = isChosen ? colours.accent : colours.paper;
    context.beginPath();
    context.arc(cx, cy, Math.min(10, 0.5 * radius), 0, 7);
    context.fill();
    paint.text(context, String(number + 1), cx, cy + 4, {
      colour: isChosen ? "paper" : "ink",
      size: Math.min(12, radius),
      weight: 600,
      align: "center",
    });
    const load = frames.value(wheelset.slug + "_right_load_n") * (sheet.pixels / LOAD_PER_M);
    paint.arrow(context, cx, y(-0.42) + load * 0.62, 0, -load * 0.62, "right", Math.min(2.5, 0.1 * sheet.pixels));
  }

  function outline(body, sheet, y, run) {
    const { vertical, pitch } = vehicle.motion(body, run);
    const { pixels } = sheet;
    const matrix = new DOMMatrix()
      .translate(sheet.x(body.centre_m[0]), y(body.centre_m[1] - vertical))
      .rotate((-pitch * 180) / Math.PI);
    const [x0, x1] = body.x_m.map(x => (x - body.centre_m[0]) * pixels);
    const [y1, y0] = body.height_m.map(height => (body.centre_m[1] - height) * pixels);
    const path = new Path2D();
    const rake = body.kind === "body" ? 0.28 * pixels : 0;
    const flat = new Path2D();
    if (rake > 0) {
      // A shell that leans back at both ends above the buffers.
      flat.moveTo(x0 + rake, y0);
      flat.lineTo(x1 - rake, y0);
      flat.quadraticCurveTo(x1 - 0.4 * rake, y0, x1 - 0.3 * rake, y0 + 0.35 * (y1 - y0));
      flat.lineTo(x1, y0 + 0.55 * (y1 - y0));
      flat.lineTo(x1, y1);
      flat.lineTo(x0, y1);
      flat.lineTo(x0, y0 + 0.55 * (y1 - y0));
      flat.lineTo(x0 + 0.3 * rake, y0 + 0.35 * (y1 - y0));
      flat.quadraticCurveTo(x0 + 0.4 * rake, y0, x0 + rake, y0);
      flat.closePath();
    } else {
      flat.roundRect(x0, y0, x1 - x0, y1 - y0, 5);
    }
    path.addPath(flat, matrix);
    return { path, matrix, box: [x0, y0, x1, y1] };
  }

  // Windows of the cabs and a stripe: they show how the shell moves.
  function trim(context, { matrix, box: [x0, y0, x1, y1] }, pixels) {
    const path = new Path2D();
    const height = y1 - y0;
    for (const [edge, inwards] of [
      [x0, 1],
      [x1, -1],
    ]) {
      path.moveTo(edge + inwards * 0.28 * pixels, y0 + 0.16 * height);
      path.lineTo(edge + inwards * 1.05 * pixels, y0 + 0.16 * height);
      path.lineTo(edge + inwards * 1.05 * pixels, y0 + 0.4 * height);
      path.lineTo(edge + inwards * 0.2 * pixels, y0 + 0.4 * height);
      path.closePath();
    }
    const windows = new Path2D();
    windows.addPath(path, matrix);
    context.fillStyle = paint.colours.metal;
    context.globalAlpha = 0.35;
    context.fill(windows);
    const stripe = new Path2D();
    const flat = new Path2D();
    flat.rect(x0, y0 + 0.62 * height, x1 - x0, 0.1 * height);
    stripe.addPath(flat, matrix);
    context.fillStyle = paint.colours.accent;
    context.globalAlpha = 0.22;
    context.fill(stripe);
    context.globalAlpha = 1;
  }

  function draw({ context, width }) {
    if (!live.scene) return;
    live.pick.clear(context.canvas);
    const sheet = scale(width);
    const y = height_m => KEY_PX + (SKY_M - height_m) * sheet.pixels;
    ground(context, sheet, y, width);
    const runs = frames.has(1) ? [0, 1] : [0];
    for (const kind of ["body", "frame"]) {
      for (const body of live.scene.bodies.filter(body => body.kind === kind)) {
        const part = outline(body, sheet, y, 0);
        paint.shape(context, part.path, false, kind === "body" ? "shell" : "ground", "metal");
        if (kind === "body") trim(context, part, sheet.pixels);
      }
    }
    live.scene.wheelsets.forEach((wheelset, number) => wheel(context, sheet, y, wheelset, number, 0));
    live.scene.dampers.forEach((damper, number) => {
      if (damper.direction === "lateral" || damper.ends_m[0][1] < 0) return;
      const [first, second] = vehicle.ends(damper).map(([x, , h]) => [sheet.x(x), y(h)]);
      live.damper(context, first, second, damper, number, sheet.pixels / FORCE_PER_M);
    });
    if (runs.length > 1) {
      for (const body of live.scene.bodies) paint.shape(context, outline(body, sheet, y, 1).path, true);
      live.scene.wheelsets.forEach((wheelset, number) => wheel(context, sheet, y, wheelset, number, 1));
    }
    key(context, width, sheet.pixels);
  }

  // What the arrows mean and how long they are.
  function key(context, width, pixels) {
    const length = (10e3 / FORCE_PER_M) * pixels;
    paint.arrow(context, 8, 12, length, 0, "force");
    paint.text(context, "damper force 10 kN", 16 + length, 16, { size: 11.5 });
    paint.text(context, "direction of travel →", width - 8, 16, { align: "right", size: 11.5 });
  }

  live.side = { scale, FORCE_PER_M };
  live.drawSide = () =>
    paint.view("side", { height: width => KEY_PX + FOOT_PX + scale(width).pixels * (SKY_M + DEPTH_M), draw });
}
