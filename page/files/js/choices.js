"use strict";
// Choice of the signals that the curves show.
{
  const live = (globalThis.live ??= {});
  const by = id => document.getElementById(id);

  // Signals of each part of the vehicle, in the order of the scene.
  function groups() {
    const { scene } = live;
    const parts = [...scene.wheelsets, ...scene.bodies, ...scene.dampers].sort((a, b) => b.slug.length - a.slug.length);
    const found = new Map([...scene.wheelsets, ...scene.bodies, ...scene.dampers].map(({ name }) => [name, []]));
    for (const { name, label } of scene.signals) {
      if (!live.panels.isKnown(name)) continue;
      const part = parts.find(({ slug }) => name.startsWith(slug + "_"));
      if (!found.has(part?.name)) found.set(part?.name, []);
      found.get(part?.name).push([name, label]);
    }
    return found;
  }

  function scene() {
    const select = by("add-curve");
    const heads = [...groups()]
      .filter(([, list]) => list.length > 0)
      .map(([part, list]) => {
        const group = Object.assign(document.createElement("optgroup"), { label: live.words.capital(part ?? "other") });
        group.append(...list.map(([name, label]) => new Option(live.words.capital(label), name)));
        return group;
      });
    select.replaceChildren(new Option("Add a curve …", ""), ...heads);
    const topics = Object.entries(TITLES).filter(([, [, sources]]) => sources.split(" ").includes(live.scene.source));
    live.controls.options(
      by("topic"),
      topics.map(([topic, [title]]) => [topic, title]),
    );
  }

  // What can be shown together: title and sources.
  const TITLES = {
    usual: ["the usual", "page machine recording target"],
    wheelset: ["all of the chosen wheelset", "page machine recording"],
    swing: ["swing of all wheelsets", "page machine recording"],
    body: ["accelerations", "page machine recording"],
    damper: ["the chosen damper", "page machine recording target"],
  };

  // Sets of curves with one purpose.
  const TOPICS = {
    usual: () => live.panels.usual(),
    swing: () => live.scene.wheelsets.map(({ slug }) => slug + "_lateral_m"),
    body: () =>
      live.scene.bodies.flatMap(({ slug }) => [
        slug + "_lateral_acceleration_m_per_s2",
        slug + "_vertical_acceleration_m_per_s2",
      ]),
    wheelset() {
      const { slug } = live.scene.wheelsets[live.view.wheelset];
      return [
        "_lateral_m",
        "_yaw_rad",
        "_left_derailment",
        "_right_derailment",
        "_left_load_n",
        "_right_load_n",
        "_lateral_force_n",
      ].map(name => slug + name);
    },
    damper: () =>
      live.view.dampers
        .slice(0, 4)
        .flatMap(number =>
          ["_force_n", "_model_force_n", "_displacement_m", "_velocity_m_per_s"].map(
            name => live.scene.dampers[number].slug + name,
          ),
        ),
  };

  function start() {
    by("add-curve").addEventListener("change", () => {
      live.panels.add(by("add-curve").value);
      by("add-curve").value = "";
    });
    by("topic").addEventListener("change", () => {
      const names = TOPICS[by("topic").value]?.() ?? [];
      if (names.length > 0) live.panels.show(names.filter(live.panels.isKnown));
    });
    by("curves-live").addEventListener("click", live.panels.follow);
    by("curves-hold").addEventListener("click", () => live.panels.hold(live.curves.from()));
    by("curves-in").addEventListener("click", () => live.panels.zoom(-1));
    by("curves-out").addEventListener("click", () => live.panels.zoom(1));
    by("curves-back").addEventListener("click", () =>
      live.panels.hold(live.curves.from() - 0.5 * live.curves.shown.window_s),
    );
    by("curves-on").addEventListener("click", () =>
      live.panels.hold(live.curves.from() + 0.5 * live.curves.shown.window_s),
    );
  }

  Object.assign(live, { choices: { start, scene } });
}
