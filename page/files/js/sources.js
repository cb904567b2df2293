"use strict";
// What a page is for depends on its source: the engine of this page, a machine, a recording, or a target.
{
  const live = (globalThis.live ??= {});
  const by = id => document.getElementById(id);

  // Paces that can be chosen.
  const PACES = {
    vehicle: [
      [0.01, "a hundredth"],
      [0.1, "a tenth"],
      [0.5, "half"],
      [1, "real time"],
      [2, "twice"],
      [10, "ten times"],
    ],
    recording: [
      [0.1, "a tenth"],
      [0.25, "a quarter"],
      [0.5, "half"],
      [1, "real time"],
      [2, "twice"],
      [5, "five times"],
      [10, "ten times"],
    ],
  };

  const kind = () => live.scene?.source ?? live.setup?.source;
  const isRecording = () => kind() === "recording";
  const isTarget = () => kind() === "target";
  // Is there a vehicle that one can change?
  const isVehicle = () => !isRecording() && !isTarget();

  function paces() {
    live.controls.options(by("factor"), PACES[isRecording() ? "recording" : "vehicle"]);
    by("factor").value = "1";
  }

  // Shows what is there for the source: `data-only` of a part lists its sources.
  function scene() {
    for (const place of document.querySelectorAll(".live [data-only]"))
      place.classList.toggle("elsewhere", !place.dataset.only.split(" ").includes(kind()));
    document.body.dataset.source = kind();
    paces();
    by("step").title = isRecording() ? "One tick, then pause" : "Ten ticks, then pause";
    if (isVehicle()) return;
    const title = isRecording() ? "Dashpot replay" : "Dashpot target";
    live.verdict.put("title", title);
    document.title = title;
  }

  Object.assign(live, { sources: { scene, paces, isRecording, isTarget, isVehicle } });
}
