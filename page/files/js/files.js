"use strict";
// Files: a state to save and load, recordings, and a picture of the drawings.
{
  const live = (globalThis.live ??= {});

  const by = id => document.getElementById(id);
  const tell = text => live.verdict.put("files-note", text);
  const stamp = () => `${(live.histories?.[0]?.newest?.time_s ?? 0).toFixed(1)}s`;

  function save(blob, name) {
    const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    tell(`Saved ${name}.`);
  }

  const file = async ({ name, mime, base64 }) => save(new Blob(await live.bytes(base64), { type: mime }), name);

  // The file has what is needed to know where the state belongs.
  async function saveState() {
    const { state, error } = await live.controls.ask({ do: "save" });
    if (error) return;
    const content = { kind: "dashpot live state", version: live.scene.version, setting: live.status?.setting, state };
    save(new Blob([JSON.stringify(content)], { type: "application/json" }), `dashpot-${stamp()}.state.json`);
  }

  async function loadState(chosen) {
    if (!chosen) return;
    try {
      const { kind, setting, state } = JSON.parse(await chosen.text());
      if (kind !== "dashpot live state") throw new Error("this is no saved state of this page");
      if (setting && JSON.stringify(setting.choice) !== JSON.stringify(live.status?.setting?.choice))
        await live.controls.ask({ do: "start", choice: setting.choice });
      const { error } = await live.controls.ask({ do: "load", state });
      if (!error) tell(`Loaded ${chosen.name}.`);
    } catch (error) {
      tell(`${chosen.name} cannot be loaded: ${error.message}.`);
    }
    by("load").value = "";
  }

  // Heading, drawings and their names, one below the other, on the colour of the paper.
  function picture() {
    const { colours, text } = live.paint;
    const shown = live.paint.views.filter(({ canvas, width }) => width > 0 && canvas.offsetParent);
    const [gap, head] = [26, 64];
    const width = Math.max(...shown.map(({ width }) => width)) + 2 * gap;
    const height = head + shown.reduce((sum, { height }) => sum + height + gap + 14, gap);
    const canvas = Object.assign(document.createElement("canvas"), { width: 2 * width, height: 2 * height });
    const context = canvas.getContext("2d");
    context.scale(2, 2);
    context.fillStyle = colours.paper;
    context.fillRect(0, 0, width, height);
    const { recording, target, vehicle, case: course } = live.scene;
    const subject = target
      ? `Target at ${target.line}`
      : `${vehicle}, ${course}${recording ? `, ${recording.name}` : ""}`;
    text(context, subject, gap, 30, { colour: "ink", size: 17, weight: 600 });
    const speed = target ? "" : `${by("speed-now").textContent} km/h, `;
    const now = `${speed}${by("time-now").textContent}`;
    const drawn = target ? "" : ` Displacements times ${live.view.exaggeration}.`;
    const state = `${by("verdict-text").textContent}.${drawn}`;
    text(context, `${now}. ${state}`, gap, 50);
    let y = head;
    for (const surface of shown) {
      const label = surface.canvas.getAttribute("aria-label")?.split(".")[0] ?? "";
      text(context, label, gap, y + 10);
      surface.paint();
      context.drawImage(surface.canvas, gap, y + 14, surface.width, surface.height);
      y += surface.height + gap + 14;
    }
    canvas.toBlob(blob => save(blob, `dashpot-${stamp()}.png`), "image/png");
  }

  async function recording(format) {
    const answer = await live.controls.ask({ do: "recording", format });
    if (answer.base64) file(answer);
  }

  // The same bits as the native program, or not.
  async function compareDigest() {
    live.verdict.put("digest-note", "The reference run takes some seconds …");
    const { digest, error } = await live.controls.ask({ do: "digest" });
    const wanted = live.scene.native_digest || live.setup.native_digest;
    const text = error
      ? `✕ ${error}`
      : digest === wanted
        ? "✓ The same bits as the native program."
        : "✕ Not the bits of the native program.";
    live.verdict.put("digest-note", `${text} ${error ? "" : digest.slice(0, 12)}`.trim());
  }

  function status() {
    const { is_recording: isOn, recorded_ticks: ticks } = live.status;
    live.verdict.put("record-text", isOn ? "Stop recording" : "Record");
    by("record").setAttribute("aria-pressed", String(Boolean(isOn)));
    const seconds = (ticks ?? 0) * (live.scene?.step_s ?? 1e-3);
    live.verdict.put("recorded", ticks > 0 ? `${seconds.toFixed(1)} s recorded` : "Nothing recorded yet");
    for (const id of ["save-csv", "save-mdf4"]) by(id).disabled = !(ticks > 0);
  }

  function start() {
    const on = (id, handle) => by(id).addEventListener("click", handle);
    on("save", saveState);
    on("load-button", () => by("load").click());
    by("load").addEventListener("change", () => loadState(by("load").files[0]));
    on("picture", picture);
    on("digest", compareDigest);
    on("record", () => live.controls.ask({ do: "record", on: !live.status?.is_recording }));
    on("save-csv", () => recording("csv"));
    on("save-mdf4", () => recording("mdf4"));
  }

  Object.assign(live, { files: { start, status, file } });
}
