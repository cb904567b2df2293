"use strict";
// Worker of the page: runs the WebAssembly engine at the wanted pace and passes messages and frames on.
{
  // A frame of the screen, and the longest stretch of work between two looks at the messages.
  const FRAME_MS = 1000 / 60;
  const SLICE_MS = 12;
  // Time that is caught up after a pause of the browser; more is given up.
  const BEHIND_MS = 250;
  // Simulated time of a frame at real time. Shorter than a frame of the screen, so that loops are smooth.
  const PART_S = 0.005;
  const SLOWER_THAN_WANTED = 8;

  const encode = text => new TextEncoder().encode(text);
  const decode = bytes => new TextDecoder().decode(bytes);
  const soon = new MessageChannel();
  let engine = null;
  let step_s = 1e-3;
  let factor = 1;
  let status = null;
  let hasEnded = false;
  let owed_s = 0;
  let last = performance.now();
  let timer = 0;
  // Wanted and made time of the last second or so.
  const pace = { wanted_s: 0, made_s: 0, isSlow: false };

  const memory = (at, length) => new Uint8Array(engine.memory.buffer, at, length);

  function tell(messages) {
    for (const message of messages) {
      if (message.type === "scene") step_s = message.step_s;
      if (message.type === "status") {
        hasEnded = Boolean(message.ended);
        message.factor = factor;
        status = message;
      }
    }
    if (messages.length > 0) postMessage({ messages });
  }

  function ask(message) {
    const text = encode(JSON.stringify(message));
    memory(engine.input(text.length), text.length).set(text);
    engine.message(text.length);
    const length = engine.output_len();
    tell(length > 0 ? JSON.parse(decode(memory(engine.output_ptr(), length))) : []);
  }

  function answer(id) {
    const messages = id === undefined ? [] : [{ type: "answer", id, error: null }];
    if (status) messages.push({ ...status, factor });
    postMessage({ messages });
  }

  // Copies the frames of all runs out of the engine.
  function take(frames, mean_us, greatest_us) {
    for (let run = 0; run < engine.runs(); run++) {
      const at = engine.frame(run);
      const frame = memory(at, engine.frame_len()).slice();
      const view = new DataView(frame.buffer);
      view.setFloat32(32, mean_us, true);
      view.setFloat32(36, greatest_us, true);
      if (pace.isSlow) view.setUint32(44, view.getUint32(44, true) | SLOWER_THAN_WANTED, true);
      frames.push(frame.buffer);
    }
  }

  function send(frames) {
    if (frames.length > 0) postMessage({ frames }, frames);
  }

  // Makes ticks in parts, each with its own frame, until nothing is owed or the slice is over.
  function work(wanted, until) {
    const part = Math.max(1, Math.round((PART_S * Math.max(1, factor)) / step_s));
    const frames = [];
    let [made, greatest_us] = [0, 0];
    const begin = performance.now();
    while (made < wanted) {
      const start = performance.now();
      const ticks = Math.min(part, wanted - made);
      const done = engine.advance(ticks);
      made += done;
      const now = performance.now();
      if (done > 0) {
        greatest_us = Math.max(greatest_us, (1e3 * (now - start)) / done);
        take(frames, (1e3 * (now - begin)) / made, greatest_us);
      }
      if (done < ticks) {
        hasEnded = true;
        ask({ do: "status" });
        break;
      }
      if (now > until) break;
    }
    send(frames);
    return made;
  }

  function measure(wanted_s, made_s) {
    pace.wanted_s += wanted_s;
    pace.made_s += made_s;
    if (pace.wanted_s < factor) return;
    pace.isSlow = pace.made_s < 0.97 * pace.wanted_s;
    Object.assign(pace, { wanted_s: 0, made_s: 0 });
  }

  function pump() {
    clearTimeout(timer);
    const now = performance.now();
    const wanted_s = factor * 1e-3 * (now - last);
    last = now;
    if (!engine || factor === 0 || hasEnded) return;
    owed_s = Math.min(owed_s + wanted_s, factor * 1e-3 * BEHIND_MS);
    const ticks = Math.floor(owed_s / step_s + 1e-6);
    const made_s = ticks > 0 ? work(ticks, now + SLICE_MS) * step_s : 0;
    owed_s -= made_s;
    measure(wanted_s, made_s);
    // Messages that have arrived are handled before the next slice in both cases.
    if (owed_s > step_s) soon.port2.postMessage(null);
    else timer = setTimeout(pump, Math.max(0, FRAME_MS - (performance.now() - now)));
  }

  function resume() {
    last = performance.now();
    owed_s = 0;
    Object.assign(pace, { wanted_s: 0, made_s: 0, isSlow: false });
    clearTimeout(timer);
    timer = setTimeout(pump, 0);
  }

  function step(ticks) {
    factor = 0;
    work(ticks, Infinity);
  }

  function handle(message) {
    if (message.do === "run") {
      factor = Math.max(0, Number(message.factor) || 0);
      answer(message.id);
      resume();
    } else if (message.do === "step") {
      step(Math.min(10000, message.ticks ?? 1));
      answer(message.id);
    } else {
      if (message.do === "stop") factor = 0;
      ask(message);
      if (["start", "reset", "load", "compare"].includes(message.do)) {
        const frames = [];
        take(frames, 0, 0);
        send(frames);
        resume();
      }
    }
  }

  // Gives the engine its tables of contact; without them it computes its own, which takes long.
  function store({ name, content }) {
    const letters = encode(name);
    const place = memory(engine.input(letters.length + content.byteLength), letters.length + content.byteLength);
    place.set(letters);
    place.set(new Uint8Array(content), letters.length);
    engine.tables(letters.length);
  }

  async function begin({ module, tables }) {
    engine = (await WebAssembly.instantiate(module, {})).instance.exports;
    tables.forEach(store);
    for (const message of waiting.splice(0)) handle(message);
    setInterval(() => ask({ do: "status" }), 1000);
  }

  const waiting = [];
  const failed = error => postMessage({ messages: [{ type: "failed", error: String(error?.message ?? error) }] });

  onmessage = ({ data }) => {
    try {
      if (data.module) begin(data).catch(failed);
      else if (engine) handle(data);
      else waiting.push(data);
    } catch (error) {
      failed(error);
    }
  };
  soon.port1.onmessage = () => {
    try {
      pump();
    } catch (error) {
      failed(error);
    }
  };
}
