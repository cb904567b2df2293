"use strict";
// Buttons and sliders for the run: pace, speed, friction, defects, gusts, comparison.
{
  const live = (globalThis.live ??= {});
  const { words } = live;
  const { put } = live.verdict;

  const by = id => document.getElementById(id);
  // What only an operator may use. A viewer may stop a rig.
  const OPERATED = `.try button, .bar button:not(.emergency), #factor, #quantities input, #fault, #preset, #as-new,
    #all-as-new, #speed, #speed-number, #friction, #friction-number, #defect-put, #gust-left, #gust-right,
    #loop-compare, #save, #load-button, #record, #start button, #replay-time, #motion input, #clear-status`;
  // The factor to which "Run" returns after a pause.
  let pace = 1;
  // The error that is shown, until the next success.
  let failure = "";
  // The scene whose lead is written; the speed comes with the status.
  let told = null;

  // Sends a message and shows the error of its answer, if any.
  async function ask(message) {
    const answer = await live.source.send(message);
    if (answer.error) note((failure = answer.error));
    else if (failure !== "" && by("note").textContent === failure) note((failure = ""));
    return answer;
  }

  function note(text) {
    put("note", text);
    by("note").hidden = text === "";
  }

  const act = action => ask({ do: "act", action });
  const isPaused = () => (live.status?.factor ?? 0) === 0;

  function run(factor) {
    if (factor > 0) pace = factor;
    return ask({ do: "run", factor });
  }
  // At the end of a recording it plays from its start.
  async function toggle() {
    if (isPaused() && live.sources.isRecording() && live.replay.isAtEnd()) await live.replay.toStart();
    return run(isPaused() ? pace : 0);
  }
  const resume = () => isPaused() && run(pace);
  const step = () => ask({ do: "step", ticks: live.sources.isRecording() ? 1 : 10 });
  const stop = () => ask({ do: "stop" });

  function reset() {
    live.defects = [];
    live.curves.reset();
    return ask({ do: "reset" });
  }

  const compare = () => ask({ do: "compare", on: !live.status?.is_comparing });

  function defect(kind, size) {
    const known = live.scene.defects.find(defect => defect.kind === kind);
    const front = Math.max(...live.scene.wheelsets.map(({ x_m }) => x_m));
    // The drawing shows where it will be: ahead of the leading wheelset.
    (live.defects ??= []).push({
      at_m: live.vehicle.distance() + front + (live.scene.ahead_m ?? 30),
      label: known.label.split(",")[0],
    });
    live.defects = live.defects.slice(-8);
    return act({ action: "defect", kind, size });
  }

  // Connects a slider with its number: `send` after each change, but not more often than each 150 ms.
  function pair(range, number, send, { toValue = Number, toPart = Number } = {}) {
    let timer = 0;
    const later = value => {
      clearTimeout(timer);
      timer = setTimeout(() => send(value), 150);
    };
    range.addEventListener("input", () => {
      const value = toValue(range.value);
      number.value = Number(value.toPrecision(3));
      later(Number(number.value));
    });
    number.addEventListener("change", () => {
      if (number.value === "") return;
      const value = Math.min(Number(number.max), Math.max(Number(number.min), Number(number.value)));
      if (!Number.isFinite(value)) return;
      number.value = value;
      range.value = toPart(value);
      send(value);
    });
  }

  function options(select, list) {
    select.replaceChildren(...list.map(([value, text]) => new Option(text, value)));
  }

  // Fills what depends on the scene.
  function scene() {
    options(
      by("defect-kind"),
      live.scene.defects.map(({ kind, label }) => [kind, words.capital(label)]),
    );
    options(
      by("wheelset"),
      live.scene.wheelsets.map(({ name }, n) => [n, `${n + 1}: ${name}`]),
    );
    by("wheelset").value = live.view.wheelset;
    defectSize();
    const hasYaw = live.scene.dampers.some(({ direction }) => direction === "longitudinal");
    put("try-worsen", hasYaw ? "Worsen the yaw dampers" : "Worsen the dampers");
    put("case-name", live.scene.case);
    put("track-name", live.scene.track);
    const [slowest, fastest] = live.scene.speed_range_km_h ?? [10, 350];
    for (const id of ["speed", "speed-number"]) Object.assign(by(id), { min: slowest, max: fastest });
    const hasRig = live.scene.source === "machine" && live.scene.has_rig;
    by("emergency").hidden = !(hasRig || live.sources.isTarget());
  }

  function defectSize() {
    const known = live.scene.defects.find(({ kind }) => kind === by("defect-kind").value);
    if (!known) return;
    Object.assign(by("defect-size"), { min: known.min, max: known.max, value: known.value, step: "any" });
    put("defect-unit", known.size_unit);
  }

  function lead(speed_km_h) {
    told = live.scene;
    const { recording, target, vehicle } = live.scene;
    if (target) {
      const advice = "Look for a loop of the target that leaves the loop of the model.";
      return put("lead", `A target with ${target.dampers} dampers at ${target.line}. ${advice}`);
    }
    if (recording) {
      const advice = "Drag the time to where something happens, or play it slowly.";
      return put("lead", `${recording.name}: a recording of a ${vehicle}. ${advice}`);
    }
    const article = /^[aeiou]/i.test(live.scene.vehicle) ? "An" : "A";
    const hasYaw = live.scene.dampers.some(({ direction }) => direction === "longitudinal");
    const advice = `Open the clearance of a ${hasYaw ? "yaw damper" : "damper"} and watch the wheels.`;
    put("lead", `${article} ${live.scene.vehicle} at ${words.fixed(speed_km_h, 0)} km/h. ${advice}`);
  }

  function status() {
    const { factor, speed_km_h, friction_factor, is_comparing, warnings, role, viewers } = live.status;
    if (factor > 0) pace = factor;
    if (told !== live.scene) lead(speed_km_h);
    put("run-text", factor > 0 ? "Pause" : live.sources.isRecording() ? "Play" : "Run");
    by("run").dataset.state = factor > 0 ? "running" : "paused";
    const select = by("factor");
    if (document.activeElement !== select)
      select.value = [...select.options].find(({ value }) => Number(value) === pace)?.value ?? "";
    for (const [id, value] of [
      ["speed", speed_km_h],
      ["friction", friction_factor],
    ]) {
      if (!Number.isFinite(value ?? NaN)) continue;
      if ([by(id), by(id + "-number")].includes(document.activeElement)) continue;
      by(id).value = value;
      by(id + "-number").value = Number(value.toPrecision(3));
    }
    by("compare").setAttribute("aria-pressed", String(Boolean(is_comparing)));
    for (const place of document.querySelectorAll(".needs-new")) place.hidden = !is_comparing;
    for (const place of document.querySelectorAll(".lacks-new")) place.hidden = Boolean(is_comparing);
    put("warnings", (warnings ?? []).join(" "));
    by("warnings").hidden = !(warnings?.length > 0);
    const isViewer = (role ?? live.scene?.role) === "viewer";
    put(
      "role",
      isViewer
        ? "You are watching. Another page may operate this run; when it has left, you can."
        : viewers > 1
          ? `${viewers} pages watch this run.`
          : "",
    );
    by("take-over").hidden = !isViewer;
    permit(!isViewer);
  }

  function permit(isAllowed) {
    for (const place of document.querySelectorAll(OPERATED))
      place.disabled = !isAllowed || place.hasAttribute("data-unknown");
  }

  function start() {
    // Nothing to operate before the first status; another case may be started at any time.
    permit(false);
    live.sources.paces();
    by("start").querySelector("button").disabled = false;
    const on = (id, handle, event = "click") => by(id).addEventListener(event, handle);
    on("run", toggle);
    on("step", step);
    on("reset", reset);
    on("compare", compare);
    on("loop-compare", compare);
    on("emergency", stop);
    on("take-over", () => ask({ do: "take-over" }));
    on("factor", () => run(Number(by("factor").value)), "change");
    on("wheelset", () => live.dampers.chooseWheelset(Number(by("wheelset").value)), "change");
    on(
      "exaggeration",
      () => ((live.view.exaggeration = Number(by("exaggeration").value)), live.paint.refresh()),
      "change",
    );
    on("defect-kind", defectSize, "change");
    on("defect-put", () => defect(by("defect-kind").value, Number(by("defect-size").value)));
    on("gust-left", () => gust(1));
    on("gust-right", () => gust(-1));
    pair(by("speed"), by("speed-number"), speed_km_h => act({ action: "speed", speed_km_h }));
    pair(by("friction"), by("friction-number"), factor => act({ action: "friction", factor }));
  }

  const gust = sign =>
    act({
      action: "gust",
      force_n: sign * 1000 * Number(by("gust-force").value),
      duration_s: Number(by("gust-duration").value),
    });

  Object.assign(live, {
    controls: {
      start,
      scene,
      status,
      ask,
      act,
      note,
      run,
      toggle,
      resume,
      defect,
      step,
      stop,
      reset,
      compare,
      pair,
      options,
    },
  });
}
