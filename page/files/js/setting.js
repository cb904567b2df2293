"use strict";
// A link that holds the whole setting: JSON, deflated, as base64url after `#s=`.
{
  const live = (globalThis.live ??= {});

  const through = async (bytes, stream) =>
    new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

  async function pack(setting) {
    const bytes = await through(
      new TextEncoder().encode(JSON.stringify(setting)),
      new CompressionStream("deflate-raw"),
    );
    let letters = "";
    for (const byte of bytes) letters += String.fromCharCode(byte);
    return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
  }

  async function unpack(text) {
    const letters = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(letters, letter => letter.charCodeAt(0));
    return JSON.parse(new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw"))));
  }

  // The setting in the address, or null.
  async function read() {
    const text = new URLSearchParams(location.hash.slice(1)).get("s");
    if (!text) return null;
    try {
      return await unpack(text);
    } catch {
      live.controls.note("The link is damaged, so the page starts with its usual setting.");
      return null;
    }
  }

  const view = () => ({
    exaggeration: live.view.exaggeration,
    wheelset: live.view.wheelset,
    dampers: live.view.dampers,
    window_s: live.curves.shown.window_s,
    signals: live.panels.names(),
  });

  // Takes what a link says about the view, as far as it makes sense.
  function look(seen) {
    if (!seen) return;
    const isNumber = value => Number.isFinite(value) && value >= 0;
    for (const name of ["exaggeration", "wheelset"]) if (isNumber(seen[name])) live.view[name] = seen[name];
    if (Array.isArray(seen.dampers) && seen.dampers.every(isNumber)) live.view.dampers = seen.dampers;
    if (isNumber(seen.window_s) && seen.window_s > 0) live.curves.shown.window_s = seen.window_s;
    if (Array.isArray(seen.signals)) live.view.signals = seen.signals.map(String);
  }

  async function link() {
    const setting = { ...(live.status?.setting ?? { choice: live.setup.choice, actions: [] }), view: view() };
    const address = new URL(location.href);
    const hash = new URLSearchParams(location.hash.slice(1));
    hash.set("s", await pack(setting));
    // A token is a secret of this machine, so it is not part of a link.
    hash.delete("token");
    address.hash = hash.toString();
    return address.href;
  }

  async function share() {
    const place = document.getElementById("link");
    place.value = await link();
    place.parentElement.hidden = false;
    if (live.setup.source === "page") history.replaceState(null, "", place.value);
    place.select();
    let isCopied = true;
    await navigator.clipboard.writeText(place.value).catch(() => (isCopied = false));
    live.verdict.put(
      "files-note",
      isCopied
        ? "The link is copied. It reproduces this run from its start."
        : "Copy the link from the field. It reproduces this run from its start.",
    );
  }

  const start = () => document.getElementById("share").addEventListener("click", share);

  Object.assign(live, { setting: { start, pack, unpack, read, look, link } });
}
