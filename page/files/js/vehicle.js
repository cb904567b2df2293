"use strict";
// Where the parts of the vehicle are: displacements by body, points on bodies, dampers, and the course of the track.
{
  const live = (globalThis.live ??= {});
  const { value } = live.frames;

  const STILL = { lateral: 0, vertical: 0, roll: 0, pitch: 0, yaw: 0 };

  // Displacements of a body or wheelset, times the exaggeration.
  function motion(part, run = 0) {
    if (!part) return STILL;
    const factor = live.view.exaggeration;
    const of = suffix => factor * value(part.slug + suffix, run);
    return {
      // The place of a rigid vehicle in a curve is no displacement, so it is not exaggerated.
      lateral: of("_lateral_m") - (factor - 1) * chord(part),
      vertical: of("_vertical_m"),
      roll: of("_roll_rad"),
      pitch: of("_pitch_rad"),
      yaw: of("_yaw_rad"),
    };
  }

  // Distances of the supports of a body from its centre: bogies of a body, wheelsets of a frame.
  const supports = new WeakMap();
  function support(part) {
    if (!supports.has(part)) {
      const all =
        part.kind === "body" ? frames().map(frame => frame.centre_m[0]) : live.scene.wheelsets.map(set => set.x_m);
      const near = all.filter(x => x >= part.x_m[0] && x <= part.x_m[1]).map(x => (x - part.centre_m[0]) ** 2);
      supports.set(part, near.length === 0 ? 0 : near.reduce((sum, square) => sum + square, 0) / near.length);
    }
    return supports.get(part);
  }

  // How far inside of the track's middle a rigid body lies in a curve.
  function chord(part) {
    return part.centre_m ? 0.5 * course(distance() + part.centre_m[0]).curvature * support(part) : 0;
  }

  const carries = (body, x) => x >= body.x_m[0] - 0.6 && x <= body.x_m[1] + 0.6;
  const frames = () => live.scene.bodies.filter(body => body.kind === "frame");
  const frameAt = x => frames().find(body => carries(body, x));
  const bodyAt = x => live.scene.bodies.find(body => body.kind === "body" && carries(body, x)) ?? live.scene.bodies[0];

  // Ends of a damper in the drawing [x, y, height, middle of the body], moved with their bodies. Ends at one point are
  // drawn apart, in the direction of the damper around that point, so that one sees and picks the damper.
  const APART = { vertical: [0, 0, 0.62], lateral: [0, 0.55, 0], longitudinal: [0.72, 0, 0] };
  function ends(damper, run = 0) {
    const [first, second] = damper.ends_m;
    const gap = Math.hypot(...first.map((at, axis) => second[axis] - at));
    const away = APART[damper.direction] ?? APART.vertical;
    const side =
      damper.direction === "lateral"
        ? -Math.sign(first[1] || 1)
        : damper.direction === "longitudinal"
          ? inwards(first[0])
          : 1;
    const apart = sign => first.map((at, axis) => 0.5 * (at + second[axis] + sign * side * away[axis]));
    const [from, to] = gap > 0.25 ? [first, second] : [apart(-1), apart(1)];
    const [lower, upper] = carriers(damper);
    return [moved(from, lower, run), moved(to, upper, run)];
  }

  // The bodies at the ends of a damper; the frame first, then the body, if the source does not tell.
  function carriers({ on = [], ends_m: [[x]] }) {
    const named = slug => live.scene.bodies.find(body => body.slug === slug);
    return [named(on[0]) ?? frameAt(x) ?? bodyAt(x), named(on[1]) ?? bodyAt(x)];
  }

  // A damper along the track points to the middle of its bogie, where there is room between the wheels.
  function inwards(x) {
    const frame = frameAt(x);
    return -Math.sign(x - (frame?.centre_m[0] ?? 0)) || 1;
  }

  function moved([x, y, height], part, run) {
    const { lateral, vertical, roll, pitch, yaw } = motion(part, run);
    const [dx, dz] = [x - part.centre_m[0], part.centre_m[1] - height];
    return [
      x - yaw * y,
      y + lateral - roll * dz + yaw * dx,
      height - vertical - roll * y + pitch * dx,
      part.centre_m[0],
    ];
  }

  const changed = number => Boolean(live.status?.dampers?.[number]?.changed || live.status?.dampers?.[number]?.fault);
  const force = (damper, run = 0) => value(damper.slug + "_force_n", run);

  // Curvature (1/m) and cant (m) of the track at a distance.
  function course(distance) {
    const corners = live.scene?.course ?? [];
    if (corners.length === 0) return { curvature: 0, cant: 0 };
    let next = corners.findIndex(([at]) => at > distance);
    if (next === 0) next = 1;
    if (next < 0 || corners.length === 1) {
      const [, curvature, cant] = corners[next < 0 ? corners.length - 1 : 0];
      return { curvature, cant };
    }
    const [[from, k0, h0], [to, k1, h1]] = [corners[next - 1], corners[next]];
    const part = Math.min(1, Math.max(0, (distance - from) / (to - from || 1)));
    return { curvature: k0 + part * (k1 - k0), cant: h0 + part * (h1 - h0) };
  }

  function courseInWords(distance) {
    const { curvature, cant } = course(distance);
    if (Math.abs(curvature) < 1e-5) return "straight track";
    const radius = Math.round(1 / Math.abs(curvature) / 10) * 10;
    const tilt = Math.abs(cant) < 5e-4 ? "" : `, cant ${Math.round(1000 * Math.abs(cant))} mm`;
    const way = curvature > 0 ? "right" : "left";
    return `curve to the ${way}, radius ${radius > 20000 ? "over 20 km" : `${radius} m`}${tilt}`;
  }

  // A recording may lack the distance; then the vehicle stands at its start.
  const distance = () => {
    const known = live.histories?.[0]?.newest?.distance_m;
    return Number.isFinite(known) ? known : (live.scene?.start_m ?? 0);
  };
  // Speed over the newest half second of the run, else the wanted one.
  function speed() {
    const history = live.histories?.[0];
    if (history?.newest && history.end - history.start > 10) {
      const from = history.after(history.newest.time_s - 0.5) % live.frames.ROWS;
      const time = history.newest.time_s - history.times[from];
      const way = history.newest.distance_m - history.distances[from];
      if (time > 0.02 && Number.isFinite(way)) return way / time;
    }
    return (live.status?.speed_km_h ?? 0) / 3.6;
  }

  Object.assign(live, {
    vehicle: { motion, frames, frameAt, bodyAt, ends, changed, force, course, courseInWords, distance, speed },
  });
}
