"use strict";
// Frames on their way into the histories. A burst, such as after a jump in a recording, is spread over frames of the
// screen, so that the page stays responsive.
{
  const live = (globalThis.live ??= {});

  // Time for frames that arrive between two frames of the screen, and for those that wait at the next.
  const BUDGET_MS = 3;
  const LOOK = 16;

  let waiting = [];
  let at = 0;

  function clear() {
    [waiting, at] = [[], 0];
  }

  // Takes what waits, as far as the budget allows. Returns whether anything was taken.
  function drain(take, budget_ms = Math.max(1, BUDGET_MS - live.timing.pending_ms)) {
    const start = performance.now();
    const first = at;
    while (at < waiting.length) {
      take(waiting[at++]);
      if (at % LOOK === 0 && performance.now() - start > budget_ms) break;
    }
    const isTaken = at > first;
    if (at >= waiting.length) clear();
    return isTaken;
  }

  // Takes a frame now, or later if the page has no time left. Nothing is drawn in a hidden page, so it takes all.
  function push(buffer, take) {
    if (document.hidden) drain(take, Infinity);
    if (waiting.length > 0 || (live.timing.pending_ms > BUDGET_MS && !document.hidden)) waiting.push(buffer);
    else take(buffer);
  }

  Object.assign(live, { inbox: { push, drain, clear } });
}
