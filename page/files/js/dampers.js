"use strict";
// The panel of a damper, or of all dampers of a kind: a slider for each quantity, presets, faults, and as new.
{
  const live = (globalThis.live ??= {});
  const { words } = live;

  const by = id => document.getElementById(id);
  const KINDS = { longitudinal: "yaw dampers", lateral: "lateral dampers", vertical: "vertical dampers" };
  const LOOP = "The loop shows the first.";
  let rows = [];

  const chosen = () => live.view.dampers.map(number => live.scene.dampers[number]);
  const each = action => {
    for (const { name } of chosen()) live.controls.act({ ...action, damper: name });
  };

  // Quantities of the first chosen damper. A preset may be of another kind, whose quantities the status then lists.
  function quantities() {
    const number = live.view.dampers[0];
    const state = live.status?.dampers?.[number];
    const list = state?.quantities ?? live.scene.dampers[number].quantities;
    return list.filter(({ key }) => !state?.values || key in state.values);
  }

  const keys = list => list.map(({ key }) => key).join();

  function fill() {
    // Nobody knows whether the dampers of a target are new.
    const origin = live.sources.isTarget() ? "at the start" : "as new";
    const change = key => value => each({ action: "damper", key, value });
    rows = quantities().map(quantity => live.quantity.row(quantity, origin, change(quantity.key)));
    by("quantities").replaceChildren(...rows.map(({ place }) => place));
  }

  function build() {
    const [damper] = chosen();
    fill();
    live.controls.options(by("preset"), [["", "choose …"], ...(damper.presets ?? []).map(name => [name, name])]);
    live.controls.options(by("fault"), [
      ["", "choose …"],
      ...live.scene.faults.map(({ id, label }) => [id, words.capital(label)]),
    ]);
    by("outside").hidden = !damper.outside;
    const text =
      live.view.dampers.length > 1
        ? `${live.sources.isRecording() ? "" : `${live.view.dampers.length} dampers change together. `}${LOOP}`
        : "";
    live.verdict.put("damper-count", text);
    live.verdict.put("loop-name", words.capital(damper.name));
    status();
  }

  // Follows the values of the source, such as after a fault, a load or another operator.
  function status() {
    const number = live.view.dampers[0];
    const state = live.status?.dampers?.[number];
    if (!state?.values) return;
    if (keys(rows) !== keys(quantities())) fill();
    for (const { key, show } of rows) if (key in state.values) show(state.values[key]);
    if (!live.sources.isVehicle()) return;
    const changed = live.scene.dampers.filter((_, n) => live.vehicle.changed(n)).length;
    const fault = live.scene.faults.find(({ id }) => id === state.fault);
    live.verdict.put(
      "damper-state",
      fault ? `▲ Fault: ${fault.label}.` : state.changed ? "▲ Not as new." : "✓ As new.",
    );
    live.verdict.put(
      "damper-changed",
      changed === 0 ? "" : `${changed} of ${live.scene.dampers.length} dampers are not as new.`,
    );
  }

  function choose(numbers) {
    live.view.dampers = numbers;
    const group = [...by("damper").options].find(({ value }) => value === numbers.join(","));
    by("damper").value = group ? group.value : String(numbers[0]);
    build();
    live.paint.refresh();
  }

  function chooseWheelset(number) {
    live.view.wheelset = number;
    by("wheelset").value = number;
    live.verdict.put("contact-name", `wheelset ${number + 1}`);
    live.paint.refresh();
  }

  function scene() {
    const { dampers } = live.scene;
    const group = (label, list) => {
      const place = Object.assign(document.createElement("optgroup"), { label });
      place.append(...list.map(([numbers, text]) => new Option(text, numbers.join(","))));
      return place;
    };
    const kinds = Object.keys(KINDS).map(kind => [
      dampers.flatMap(({ direction }, n) => (direction === kind ? [n] : [])),
      KINDS[kind],
    ]);
    const together = kinds
      .filter(([numbers]) => numbers.length > 0)
      .map(([numbers, text]) => [numbers, `All ${numbers.length} ${live.sources.isTarget() ? "dampers" : text}`]);
    const single = dampers.map(({ name }, n) => [[n], words.capital(name)]);
    by("damper").replaceChildren(group("Together", together), group("One damper", single));
    // A change of all dampers of a target at once must be meant.
    const first = together[0]?.[0].slice(0, live.sources.isVehicle() ? undefined : 1) ?? [0];
    const isKnown = live.view.dampers.length > 0 && live.view.dampers.every(number => dampers[number]);
    if (dampers.length > 0) choose(isKnown ? live.view.dampers : first);
    chooseWheelset(Math.max(0, Math.min(live.view.wheelset, live.scene.wheelsets.length - 1)));
  }

  function start() {
    by("damper").addEventListener("change", () => choose(by("damper").value.split(",").map(Number)));
    by("preset").addEventListener("change", () => {
      if (by("preset").value) each({ action: "preset", preset: by("preset").value });
      by("preset").value = "";
    });
    by("fault").addEventListener("change", () => {
      if (by("fault").value) each({ action: "fault", fault: by("fault").value });
      by("fault").value = "";
    });
    by("as-new").addEventListener("click", () => each({ action: "as-new" }));
    by("all-as-new").addEventListener("click", () => {
      live.scene.dampers.forEach(({ name }, number) => {
        if (live.vehicle.changed(number)) live.controls.act({ action: "as-new", damper: name });
      });
    });
  }

  Object.assign(live, { dampers: { start, scene, status, choose, chooseWheelset } });
}
