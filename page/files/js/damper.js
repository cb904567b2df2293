"use strict";
// A damper in a drawing: cylinder, rod, the force on its ends, and a mark if it is not as new.
{
  const live = (globalThis.live ??= {});
  const { paint, vehicle } = live;

  // Draws a damper between two points in pixels. Arrows show the force on its ends: towards each other in tension.
  live.damper = (context, first, second, damper, number, pixelsPerNewton) => {
    const { colours } = paint;
    live.pick.note(context, [0.5 * (first[0] + second[0]), 0.5 * (first[1] + second[1])], { damper: number });
    const [dx, dy] = [second[0] - first[0], second[1] - first[1]];
    const length = Math.hypot(dx, dy) || 1;
    const [ux, uy] = [dx / length, dy / length];
    const at = part => [first[0] + part * dx, first[1] + part * dy];
    const isChosen = live.view.dampers.includes(number);
    const isChanged = vehicle.changed(number);
    // Thick enough to see, thin enough for a phone.
    const thick = Math.max(5, Math.min(9, 0.2 * length + 3));
    context.lineCap = "butt";
    if (isChosen) {
      context.lineCap = "round";
      context.globalAlpha = 0.3;
      paint.line(context, ...first, ...second, "accent", thick + 6);
      context.globalAlpha = 1;
      context.lineCap = "butt";
    }
    paint.line(context, ...first, ...second, "metal", 2.5);
    paint.line(context, ...at(0.12), ...at(0.6), "metal", thick);
    paint.line(context, ...at(0.15), ...at(0.57), isChanged ? "worn" : "paper", thick - 3);
    context.fillStyle = colours.metal;
    for (const [x, y] of [first, second]) {
      context.beginPath();
      context.arc(x, y, 0.3 * thick, 0, 7);
      context.fill();
    }
    if (isChanged && thick > 6)
      paint.text(context, "!", ...middle(at(0.36)), { colour: "ink", size: 9, weight: 700, align: "center" });
    // Beside the damper, so that the arrows do not hide it.
    const [ox, oy] = [-uy * (thick + 1), ux * (thick + 1)];
    const force = vehicle.force(damper) * pixelsPerNewton;
    paint.arrow(context, first[0] + ox, first[1] + oy, ux * force, uy * force, "force", 0.28 * thick);
    paint.arrow(context, second[0] + ox, second[1] + oy, -ux * force, -uy * force, "force", 0.28 * thick);
  };

  const middle = ([x, y]) => [x, y + 3.2];

  // A damper seen along its axis.
  live.damperEnd = (context, [x, y], number, radius = 5) => {
    const { colours } = paint;
    live.pick.note(context, [x, y], { damper: number });
    context.beginPath();
    context.arc(x, y, radius, 0, 7);
    context.fillStyle = vehicle.changed(number) ? colours.worn : colours.paper;
    context.fill();
    context.strokeStyle = live.view.dampers.includes(number) ? colours.accent : colours.metal;
    context.lineWidth = live.view.dampers.includes(number) ? 3 : 2;
    context.stroke();
  };
}
