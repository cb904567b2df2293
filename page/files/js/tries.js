"use strict";
// The first things to try with a vehicle. Each says where to look.
{
  const live = (globalThis.live ??= {});

  // Clearance at which everyone sees what it does.
  const WORSE_M = 0.015;
  const LOOK = {
    worsen:
      "From above: the bogies turn further before the dampers hold them. " +
      "Curves: the wheelsets swing wider, and Y/Q rises.",
    dip:
      "A dip comes towards the leading wheelset. " +
      "Curves, wheel load: the left wheel loses load as it runs in and gains load as it runs out.",
    gust:
      "The wind pushes the body to the right for 3 s. " +
      "From behind: the body leans, and the right wheels carry more.",
  };
  // The first things to try; each says where to look.
  const TRIES = {
    worsen() {
      const { scene } = live;
      const yaw = scene.dampers.filter(({ direction }) => direction === "longitudinal");
      const worsened = yaw.length > 0 ? yaw : scene.dampers;
      for (const damper of worsened) {
        const clearance = damper.quantities.find(({ key }) => key === "mount.clearance_m");
        if (clearance)
          live.controls.act({
            action: "damper",
            damper: damper.name,
            key: clearance.key,
            value: Math.min(clearance.max, WORSE_M),
          });
      }
      live.dampers.choose(worsened.map(damper => scene.dampers.indexOf(damper)));
      const noun = yaw.length > 0 ? "yaw dampers" : "dampers";
      return `The ${noun} now have ${1000 * WORSE_M} mm of clearance. ${LOOK.worsen}`;
    },
    dip() {
      const known = live.scene.defects.find(({ kind }) => kind === "dip") ?? live.scene.defects[0];
      live.controls.defect(known.kind, known.value);
      return LOOK.dip;
    },
    gust() {
      live.controls.act({ action: "gust", force_n: 30000, duration_s: 3 });
      return LOOK.gust;
    },
  };

  function tryOut(name) {
    live.verdict.put("try-look", TRIES[name]());
    document.getElementById("try-look").classList.remove("fresh");
    live.controls.resume();
  }

  function start() {
    for (const name of Object.keys(TRIES))
      document.getElementById(`try-${name}`).addEventListener("click", () => tryOut(name));
  }

  Object.assign(live, { tries: { start } });
}
