"use strict";
// Which case runs: case, vehicle, track, and the start of a run.
{
  const live = (globalThis.live ??= {});
  const by = id => document.getElementById(id);

  const named = list =>
    list.map(item => (typeof item === "string" ? [item, item] : [item.name, item.title ?? item.name]));

  // The choice that the form describes; an empty field means that of the case.
  function choice() {
    const chosen = { case: by("case").value };
    for (const name of ["vehicle", "track"]) if (by(name).value) chosen[name] = by(name).value;
    for (const [id, key] of [
      ["start-speed", "speed_km_h"],
      ["start-friction", "friction"],
      ["start-seed", "seed"],
    ])
      if (by(id).value !== "") chosen[key] = Number(by(id).value);
    const set = by("start-set")
      .value.split("\n")
      .map(line => line.trim())
      .filter(Boolean);
    return set.length > 0 ? { ...chosen, set } : chosen;
  }

  function show(chosen) {
    by("case").value = chosen.case ?? "";
    by("vehicle").value = chosen.vehicle ?? "";
    by("track").value = chosen.track ?? "";
    for (const [id, key] of [
      ["start-speed", "speed_km_h"],
      ["start-friction", "friction"],
      ["start-seed", "seed"],
    ])
      by(id).value = chosen[key] ?? "";
    by("start-set").value = (chosen.set ?? []).join("\n");
  }

  async function begin(chosen, actions = []) {
    live.defects = [];
    const answer = await live.controls.ask({ do: "start", choice: chosen, actions });
    if (!answer.error) live.controls.note("");
    return answer;
  }

  function start() {
    const { setup } = live;
    live.controls.options(by("case"), named(setup.cases));
    live.controls.options(by("vehicle"), [["", "that of the case"], ...named(setup.vehicles)]);
    live.controls.options(by("track"), [["", "that of the case"], ...named(setup.tracks)]);
    show(setup.choice ?? {});
    // A server decides what runs.
    by("start").closest("details").hidden = setup.cases.length === 0;
    by("start").addEventListener("submit", event => {
      event.preventDefault();
      live.panels.clear();
      begin(choice());
    });
  }

  Object.assign(live, { cases: { start, show, begin } });
}
