"use strict";
// The source of frames: a worker in this page or a WebSocket of the program. Both speak the same messages.
{
  const live = (globalThis.live ??= {});

  const RETRY_MS = [500, 1000, 2000, 4000, 8000];
  // Letters of base64 that are decoded at once; a multiple of four.
  const PART = 400000;

  // Answers by the number of their question.
  const waiting = new Map();
  let number = 0;

  function receive(message, handlers) {
    if (message.type === "answer" && waiting.has(message.id)) {
      waiting.get(message.id)(message);
      waiting.delete(message.id);
    } else if (message.type !== "answer") {
      handlers.message(message);
    }
  }

  // Decodes base64 in parts, so that the page stays responsive.
  async function bytes(text) {
    const parts = [];
    for (let at = 0; at < text.length; at += PART) {
      const letters = atob(text.slice(at, at + PART));
      const part = new Uint8Array(letters.length);
      for (let n = 0; n < letters.length; n++) part[n] = letters.charCodeAt(n);
      parts.push(part);
      await new Promise(resolve => setTimeout(resolve, 0));
    }
    return parts;
  }

  async function unpack(text) {
    const stream = new Blob(await bytes(text.trim())).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).arrayBuffer();
  }

  function worker(handlers) {
    const text = id => document.getElementById(id).textContent;
    // Messages before the engine is there wait for it.
    const early = [];
    let isOpen = false;
    const place = URL.createObjectURL(new Blob([text("worker")], { type: "text/javascript" }));
    const worker = new Worker(place);
    worker.onmessage = ({ data }) => {
      const start = performance.now();
      for (const message of data.messages ?? []) receive(message, handlers);
      for (const frame of data.frames ?? []) handlers.frame(frame);
      live.timing.spend(performance.now() - start);
    };
    worker.onerror = event => handlers.link("failed", event.message);
    const load = async () => {
      const module = await unpack(text("engine"));
      const tables = [];
      for (const place of document.querySelectorAll("script[data-tables]"))
        tables.push({ name: place.dataset.tables, content: await unpack(place.textContent) });
      worker.postMessage({ module, tables }, [module, ...tables.map(({ content }) => content)]);
      for (const message of early.splice(0)) worker.postMessage(message);
      isOpen = true;
      handlers.link("open");
    };
    load().catch(error => handlers.link("failed", String(error)));
    return message => (isOpen ? worker.postMessage(message) : early.push(message));
  }

  function socket(handlers) {
    const query = new URLSearchParams(location.search);
    const hash = new URLSearchParams(location.hash.slice(1));
    const token = hash.get("token") ?? query.get("token");
    const place = new URL("/live", location.href);
    place.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    // A page that is opened as `?role=viewer` only watches.
    const asked = { token, role: query.get("role") };
    place.search = new URLSearchParams(Object.entries(asked).filter(([, value]) => value)).toString();
    place.hash = "";
    let [connection, tries] = [null, 0];
    const connect = () => {
      connection = new WebSocket(place);
      connection.binaryType = "arraybuffer";
      connection.onopen = () => {
        tries = 0;
        handlers.link("open");
      };
      connection.onmessage = ({ data }) => {
        const start = performance.now();
        if (data instanceof ArrayBuffer) handlers.frame(data);
        else for (const message of [JSON.parse(data)].flat()) receive(message, handlers);
        live.timing.spend(performance.now() - start);
      };
      connection.onclose = () => {
        // A question to a lost connection never gets its answer.
        for (const [id, settle] of waiting) settle({ id, error: "the connection was lost" });
        waiting.clear();
        handlers.link("lost");
        setTimeout(connect, RETRY_MS[Math.min(tries++, RETRY_MS.length - 1)]);
      };
    };
    connect();
    return message => {
      if (connection.readyState === WebSocket.OPEN) connection.send(JSON.stringify(message));
      else receive({ type: "answer", id: message.id, error: "there is no connection" }, handlers);
    };
  }

  // Opens the source. Its `send` resolves to the answer, which has an error or null.
  function connect(kind, handlers) {
    const post = (kind === "server" ? socket : worker)(handlers);
    const send = message =>
      new Promise(resolve => {
        const id = ++number;
        waiting.set(id, resolve);
        post({ id, ...message });
      });
    return { kind, send };
  }

  Object.assign(live, { connect, bytes });
}
