"use strict";
// A recording: where in time it is, and how one goes to another time.
{
  const live = (globalThis.live ??= {});
  const by = id => document.getElementById(id);

  // A short step of the slider, and a long one.
  const [SHORT_S, LONG_S] = [0.1, 5];
  const DIGITS = 3;
  const PATIENCE_MS = 300;

  // The time that is wanted but not yet asked for, and the question that is not yet answered.
  let [wanted, asked] = [null, null];
  let going = null;
  // The time to which the source went. The frames before it come first.
  let sought_s = -Infinity;

  const ends = () => live.scene.recording ?? { start_s: 0, end_s: 0 };
  const now = () =>
    wanted ?? asked ?? Math.max(ends().start_s, sought_s, live.histories?.[0]?.newest?.time_s ?? -Infinity);
  const isBehind = () => (live.histories?.[0]?.newest?.time_s ?? -Infinity) < sought_s - 1.5 * live.scene.step_s;
  const isAtEnd = () => now() >= ends().end_s - 1.5 * live.scene.step_s;

  function inWords(time_s) {
    const { start_s, end_s } = ends();
    const of = seconds => `${live.words.fixed(seconds, DIGITS)} s`;
    return start_s === 0 ? `${of(time_s)} of ${of(end_s)}` : `${of(time_s)}, from ${of(start_s)} to ${of(end_s)}`;
  }

  function write() {
    if (!live.scene || !live.sources.isRecording()) return;
    const slider = by("replay-time");
    const words = inWords(now());
    if (by("replay-words").textContent === words) return;
    slider.value = now();
    by("replay-words").textContent = words;
    slider.setAttribute("aria-valuetext", words);
  }

  // Goes to a time. Meanwhile only the newest wish waits for its turn.
  function seek(time_s) {
    const { start_s, end_s } = ends();
    wanted = Math.min(end_s, Math.max(start_s, time_s));
    write();
    going ??= go().finally(() => (going = null));
    return going;
  }

  async function go() {
    while (wanted !== null) {
      [asked, wanted] = [wanted, null];
      await live.controls.ask({ do: "seek", time_s: asked });
      asked = null;
      // The burst of frames comes first, so that a slow line does not fill with the bursts of a drag.
      const until = performance.now() + PATIENCE_MS;
      while (isBehind() && performance.now() < until) await new Promise(resolve => setTimeout(resolve, 16));
    }
  }

  // What is drawn belongs to another time, so it begins anew.
  function sought({ time_s }) {
    sought_s = time_s;
    for (const history of live.histories ?? []) history.clear();
    live.curves.reset();
    live.panels.tell();
    live.verdict.restart();
    live.paint.refresh();
  }

  function scene() {
    if (!live.sources.isRecording()) return;
    [wanted, asked, sought_s] = [null, null, -Infinity];
    const { start_s, end_s } = ends();
    Object.assign(by("replay-time"), { min: start_s, max: end_s, step: "any", value: start_s });
    by("replay-words").textContent = "";
    write();
  }

  function press(event) {
    const step = event.shiftKey ? live.scene.step_s : SHORT_S;
    const ways = {
      ArrowLeft: () => now() - step,
      ArrowDown: () => now() - step,
      ArrowRight: () => now() + step,
      ArrowUp: () => now() + step,
      PageUp: () => now() - LONG_S,
      PageDown: () => now() + LONG_S,
      Home: () => ends().start_s,
      End: () => ends().end_s,
    };
    if (!ways[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    seek(ways[event.key]());
  }

  const toStart = () => seek(ends().start_s);

  function start() {
    by("replay-time").addEventListener("input", () => seek(Number(by("replay-time").value)));
    by("replay-time").addEventListener("keydown", press);
    by("to-start").addEventListener("click", toStart);
  }

  Object.assign(live, { replay: { start, scene, write, seek, sought, toStart, isAtEnd, isBehind } });
}
