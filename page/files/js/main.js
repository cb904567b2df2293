"use strict";
// Starts the page, passes what the source says to its parts, and draws on each frame of the screen.
{
  const live = (globalThis.live ??= {});
  const by = id => document.getElementById(id);

  // Drawing stops for this frame after so much time; what is left comes first in the next frame.
  const BUDGET_MS = 3.5;
  // The same for views that have their turn together.
  const GROUP_MS = 5;
  // So many drawings at most for a frame: without a graphics processor, the browser fills their areas after the script.
  const VIEWS = 4;
  const WRITE_MS = 250;
  // While a burst of frames is taken.
  const BUSY_MS = 1000;
  const SUMMARY_MS = 2000;

  live.setup = JSON.parse(by("setup").textContent);
  live.view = { exaggeration: 20, wheelset: 0, dampers: [], signals: null };
  live.timing = {
    frames: 0,
    mean_ms: 0,
    greatest_ms: 0,
    pending_ms: 0,
    // Time of scripts outside of the drawing counts for the next frame.
    spend(ms) {
      this.pending_ms += ms;
    },
    count(ms) {
      const all = ms + this.pending_ms;
      this.pending_ms = 0;
      this.frames++;
      this.mean_ms += (all - this.mean_ms) / this.frames;
      this.greatest_ms = Math.max(this.greatest_ms, all);
    },
    clear() {
      Object.assign(this, { frames: 0, mean_ms: 0, greatest_ms: 0, pending_ms: 0 });
    },
  };

  function scene(message) {
    const isSame = JSON.stringify(message.signals) === JSON.stringify(live.scene?.signals);
    live.scene = message;
    live.inbox.clear();
    live.defects = [];
    live.index = new Map(message.signals.map(({ name }, number) => [name, number]));
    live.histories = [new live.frames.History(message.signals.length)];
    for (const view of live.paint.views) view.fit();
    live.curves.reset();
    live.sources.scene();
    live.controls.scene();
    live.replay.scene();
    live.target.scene();
    live.verdict.restart();
    // In tasks of their own, so that none is long.
    setTimeout(() => live.dampers.scene());
    setTimeout(live.prepareContact);
    if (!isSame || live.curves.panels.length === 0) {
      setTimeout(() => {
        live.panels.show(live.view.signals ?? live.panels.usual());
        live.view.signals = null;
      });
      setTimeout(() => live.choices.scene());
    }
    live.panels.tell();
    by("waiting").hidden = true;
    by("exaggeration").value = live.view.exaggeration;
  }

  function status(message) {
    const wasComparing = live.status?.is_comparing;
    live.status = message;
    if (wasComparing && !message.is_comparing) live.histories?.[1]?.clear();
    if (!live.scene) return;
    live.controls.status();
    live.dampers.status();
    live.target.status();
    live.files.status();
    if (live.scene && message.setting?.choice) live.setup.choice = message.setting.choice;
    live.paint.refresh();
  }

  function take(buffer) {
    const frame = live.frames.decode(buffer);
    const history = (live.histories[frame.run] ??= new live.frames.History(frame.last.length));
    const isFirst = !history.newest;
    const isBack = history.push(frame);
    if (isBack && frame.run === 0) {
      live.histories[1]?.clear();
      live.curves.reset();
      live.verdict.restart();
    }
    if (isFirst && live.sources.isRecording()) known();
    received++;
  }

  // The first frame of a recording tells which signals it has.
  function known() {
    if (knownOf === live.scene) return;
    knownOf = live.scene;
    setTimeout(() => {
      live.choices.scene();
      const isThere = ({ slug }) => live.panels.isKnown(slug + "_force_n");
      const { dampers } = live.scene;
      if (!live.view.dampers.some(number => isThere(dampers[number]))) {
        const first = dampers.findIndex(isThere);
        if (first >= 0) live.dampers.choose([first]);
      }
      if (!live.panels.names().every(live.panels.isKnown)) live.panels.show(live.panels.usual());
    });
  }

  const handlers = {
    frame(buffer) {
      if (live.histories) live.inbox.push(buffer, take);
    },
    message(message) {
      if (message.type === "scene") scene(message);
      else if (message.type === "sought") sought(message);
      else if (message.type === "status") status(message);
      else if (message.type === "health") live.verdict.health(message);
      else if (message.type === "file") live.files.file(message);
      else if (message.type === "failed") live.controls.note(`The simulation has stopped: ${message.error}`);
    },
    link(state, error) {
      by("link-lost").hidden = state !== "lost";
      if (state === "failed") live.controls.note(`The simulation cannot start: ${error}`);
    },
  };

  // Frames before a jump belong to another time.
  function sought(message) {
    live.inbox.clear();
    live.replay.sought(message);
  }

  // Number of frames so far, and the recording whose signals are known.
  let received = 0;
  let knownOf = null;
  const written = { at: 0, summary: 0 };

  // The views whose turn it is, most overdue first.
  function due(now) {
    const isDue = view =>
      view.isSeen && (view.isStale || (view.frame !== received && now - view.drawn >= view.period_ms - 2));
    return live.paint.views.filter(isDue).sort((a, b) => a.drawn + a.period_ms - (b.drawn + b.period_ms));
  }

  function paint(now, start) {
    const turn = view => {
      view.paint();
      Object.assign(view, { drawn: now, frame: received });
    };
    let count = 0;
    for (const view of due(now).slice(0, VIEWS)) {
      // One at least, so that a slow machine draws, too.
      if (count > 0 && performance.now() - start > BUDGET_MS) break;
      if (view.drawn === now) continue;
      count++;
      turn(view);
      // Views with a common time have their turn together, so that their times agree.
      const others = view.group ? live.paint.views.filter(other => other.group === view.group) : [];
      for (const other of others)
        if (other.drawn !== now && other.isSeen && performance.now() - start < GROUP_MS) turn(other);
    }
  }

  function write(now) {
    written.at = now;
    live.verdict.write(now);
    live.panels.write();
    if (now - written.summary < SUMMARY_MS) return;
    written.summary = now;
    live.verdict.summary();
  }

  // Texts have a frame of the screen for themselves.
  function draw(now) {
    const start = performance.now();
    // What arrived since the last frame of the screen has used some of the time of this one.
    const begin = start - live.timing.pending_ms;
    const isBusy = live.scene && live.inbox.drain(take);
    live.replay.write();
    if (live.scene && now - written.at > (isBusy ? BUSY_MS : WRITE_MS)) write(now);
    else paint(now, begin);
    live.timing.count(performance.now() - start);
    requestAnimationFrame(draw);
  }

  const pause = () => new Promise(resolve => setTimeout(resolve));

  // In tasks of their own, so that none is long.
  async function start() {
    const { controls, dampers, cases, setting, files, keys, choices, pick, bars, tries, replay, target } = live;
    for (const part of [controls, dampers, cases, setting, files, keys, choices, pick, bars, tries, replay, target]) {
      part.start();
      await pause();
    }
    for (const view of [
      live.drawSide,
      live.drawAbove,
      live.drawBehind,
      live.drawContact,
      live.drawLoops,
      live.drawSlots,
    ])
      view();
    requestAnimationFrame(draw);
    const linked = await live.setting.read();
    live.setting.look(linked?.view);
    if (linked?.version && linked.version !== live.setup.version)
      live.controls.note(
        `The link was made by version ${linked.version}; this is ${live.setup.version}. The run may differ.`,
      );
    live.source = live.connect(live.setup.source, handlers);
    const chosen = linked?.choice ?? live.setup.choice;
    live.cases.show(chosen ?? {});
    if (live.setup.source === "page") {
      if (live.paint.isStill()) live.source.send({ do: "run", factor: 0 });
      const { error } = await live.cases.begin(chosen, linked?.actions ?? []);
      if (!error && live.paint.isStill())
        live.controls.note("Paused, because your system asks for less motion. Press Run to start.");
    } else if (linked?.choice) {
      await live.cases.begin(chosen, linked.actions ?? []);
    }
  }

  start();
}
