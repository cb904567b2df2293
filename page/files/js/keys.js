"use strict";
// Keys of the whole page. Space stops a rig wherever the focus is, except in text fields; without a rig it pauses.
{
  const live = (globalThis.live ??= {});

  const isText = ({ target }) =>
    target.matches?.('input:not([type="range"]):not([type="checkbox"]), textarea, [contenteditable]');
  const hasRig = () => !document.getElementById("emergency").hidden;

  // Another page may follow below, in which Space scrolls.
  const isInView = () => document.querySelector(".live").getBoundingClientRect().bottom > 0;

  // Without a rig, Space keeps its usual meaning on a button or in a list.
  const takesSpace = ({ target }) => target.matches?.("button, select, summary, a");

  // A target is neither paused nor stepped.
  const KEYS = {
    k: () => !live.sources.isTarget() && live.controls.toggle(),
    s: () => !live.sources.isTarget() && live.controls.step(),
    c: () => live.sources.isVehicle() && live.controls.compare(),
    l: () => live.panels.follow(),
    0: () => live.sources.isRecording() && live.replay.toStart(),
  };

  function press(event) {
    if (!live.scene) return;
    if (event.key === "Escape" && hasRig()) return live.controls.stop();
    if (!hasRig() && !isInView()) return;
    if (event.ctrlKey || event.metaKey || event.altKey || isText(event)) return;
    if (event.key === " ") {
      if (hasRig()) {
        event.preventDefault();
        event.stopPropagation();
        live.controls.stop();
      } else if (!takesSpace(event)) {
        event.preventDefault();
        live.controls.toggle();
      }
      return;
    }
    if (live.sources.isTarget() && live.scene.dampers[event.key]) live.dampers.choose([Number(event.key)]);
    else if (/^[1-9]$/.test(event.key) && live.scene.wheelsets[Number(event.key) - 1])
      live.dampers.chooseWheelset(Number(event.key) - 1);
    else if (KEYS[event.key] && !event.target.matches?.("select")) KEYS[event.key]();
  }

  function start() {
    // First of all handlers. A button reacts to Space when the key is released, which must not press it as well.
    addEventListener("keydown", press, { capture: true });
    addEventListener(
      "keyup",
      event => {
        if (event.key === " " && hasRig() && !isText(event)) event.preventDefault();
      },
      { capture: true },
    );
  }

  Object.assign(live, { keys: { start } });
}
