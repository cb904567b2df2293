"use strict";
// A target (firmware) without a vehicle: how it is moved, whether all is well with it, and what it says of itself.
{
  const live = (globalThis.live ??= {});
  const { words } = live;
  const by = id => document.getElementById(id);
  const put = (id, text) => live.verdict.put(id, text);

  // Rows of the motion, if this page moves the dampers.
  let rows = [];
  const wanted = {};

  const state = () => live.status?.target;
  const name = slot => live.scene.dampers[slot]?.name ?? `slot ${slot}`;
  const micro = value => (Number.isFinite(value) ? `${words.short(value)} µs` : "not known");
  const pairInWords = ([mean, greatest] = []) => `${micro(mean)}, at most ${micro(greatest)}`;

  // What is not well, in words.
  function troubles() {
    const { counters = [], dampers = [] } = state() ?? {};
    return [
      ...dampers.flatMap(({ slot, status = [] }) => status.map(text => `${name(slot)}: ${text}`)),
      ...dampers
        .filter(({ rejected_inputs: count }) => count > 0)
        .map(({ slot, rejected_inputs: count }) => `${name(slot)}: ${count} inputs rejected`),
      ...counters.filter(({ value }) => value > 0).map(({ label, value }) => `${label}: ${value}`),
    ];
  }

  // The state and the sentence of the bar at the top.
  function verdict() {
    if (live.status?.ended) return ["over", `Ended: ${live.status.ended}`];
    if (!state()) return ["within", "Waiting for the target"];
    const all = troubles();
    if (all.length === 0) return ["within", "All is well with the target"];
    const more = all.length > 1 ? `, and ${all.length - 1} more` : "";
    return ["near", `${words.capital(all[0])}${more}`];
  }

  const difference = newtons => (Number.isFinite(newtons ?? NaN) ? `${words.short(newtons)} N` : "not known");

  function summary() {
    const { core_version: version, line, dampers, step_s: step } = live.scene.target;
    const number = live.view.dampers[0] ?? 0;
    const { slug } = live.scene.dampers[number] ?? {};
    const most = suffix => Math.max(...live.histories[0].range(live.index.get(slug + suffix), 3).map(Math.abs));
    const all = troubles();
    const head = `Target at ${line}, core ${version}, ${dampers} dampers, a tick of ${words.short(1e3 * step)} ms.`;
    const moves =
      `In the last 3 s ${name(number)} moved by up to ${words.quantity(most("_displacement_m"), "m")}, ` +
      `with forces up to ${words.quantity(most("_force_n"), "N")}.`;
    const off = state()?.difference_n?.[number];
    const model = Number.isFinite(off ?? NaN)
      ? `The largest difference to the model is ${difference(off)}.`
      : "What the model says is not known.";
    const well = all.length === 0 ? "All is well." : `Not well: ${all.join("; ")}.`;
    put("summary", [head, moves, model, well].join(" "));
  }

  // Lines of words that keep their places, so that a reader does not lose hers.
  function facts(list) {
    const place = by("target-facts");
    while (place.children.length > list.length) place.lastElementChild.remove();
    list.forEach(([label, text], index) => {
      if (!place.children[index]) {
        const line = document.createElement("div");
        line.append(document.createElement("dt"), document.createElement("dd"));
        place.append(line);
      }
      const cells = place.children[index].children;
      [label, text].forEach((words, n) => {
        if (cells[n].textContent !== words) cells[n].textContent = words;
      });
    });
  }

  function slots({ dampers = [], difference_n: differences = [] }) {
    const place = by("target-slots");
    place.replaceChildren(
      ...dampers.map(({ slot, status = [], rejected_inputs: count }) => {
        const wrong = [...status, ...(count > 0 ? [`${count} inputs rejected`] : [])];
        const cells = [
          words.capital(name(slot)),
          wrong.length > 0 ? `▲ ${wrong.join(", ")}` : "✓ well",
          difference(differences[slot]),
        ];
        return live.row(cells, wrong.length > 0);
      }),
    );
  }

  function status() {
    const { target } = live.scene;
    const now = state();
    if (!target || !now) return;
    for (const { key, show } of rows) if (key in (live.status.motion ?? {})) show(live.status.motion[key]);
    const tick_us = 1e6 * target.step_s;
    const mean = now.work_us?.[0];
    const share = Number.isFinite(mean) ? ` (${words.fixed((100 * mean) / tick_us, 1)} % of a tick)` : "";
    facts([
      ["Line", target.line],
      ["Version of the core", target.core_version],
      ["Tick", `${words.short(1e3 * target.step_s)} ms`],
      ["Clock", target.clock_hz > 0 ? `${words.short(target.clock_hz / 1e6)} MHz` : "not known"],
      ["Ticks so far", String(now.tick ?? "not known")],
      ["Work of a tick", pairInWords(now.work_us) + share],
      ["Round trip", pairInWords(now.round_trip_us)],
      ...(now.counters ?? []).map(({ label, value }) => [words.capital(label), value > 0 ? `▲ ${value}` : "0"]),
    ]);
    slots(now);
    const all = troubles().length;
    const count = all === 1 ? "one thing is" : `${all} things are`;
    put("target-word", all === 0 ? "✓ all is well" : `▲ ${count} not well`);
    const isKnown = Number.isFinite(now.difference_n?.[live.view.dampers[0]] ?? NaN);
    put("loop-model", isKnown ? "the model" : "the model (not known)");
  }

  function scene() {
    const { motion } = live.scene;
    rows = Object.entries(motion ?? {}).map(([key, range]) => {
      wanted[key] = range.value;
      const isAmplitude = key === "amplitude_m";
      const quantity = {
        key,
        label: isAmplitude ? "amplitude" : "frequency",
        unit: isAmplitude ? "m" : "Hz",
        is_logarithmic: !isAmplitude,
        ...range,
      };
      return live.quantity.row(quantity, "at the start", value => {
        wanted[key] = value;
        live.controls.act({ action: "motion", ...wanted });
      });
    });
    by("motion").replaceChildren(...rows.map(({ place }) => place));
    by("motion-none").hidden = rows.length > 0;
  }

  function start() {
    by("clear-status").addEventListener("click", () => live.controls.ask({ do: "clear-status" }));
  }

  Object.assign(live, { target: { start, scene, status, verdict, summary } });
}
