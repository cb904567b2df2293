"use strict";
// Numbers and units as a railway engineer reads them.
{
  const live = (globalThis.live ??= {});

  // Unit of the data: factor, unit that is written, and decimals.
  const UNITS = {
    m: [1e3, "mm", 2],
    rad: [1e3, "mrad", 2],
    N: [1e-3, "kN", 1],
    "m/s": [1e3, "mm/s", 1],
    "N/m": [1e-6, "kN/mm", 2],
    "N s/m": [1e-3, "kN s/m", 1],
    "m/s²": [1, "m/s²", 2],
    degC: [1, "°C", 0],
    "°C": [1, "°C", 0],
    1: [1, "", 3],
  };

  const unit = name => {
    const [factor, text, digits] = UNITS[name] ?? [1, name ?? "", 2];
    return { factor, text, digits };
  };

  // A minus sign, and no sign for zero.
  const fixed = (value, digits) => {
    if (!Number.isFinite(value)) return "–";
    const text = value.toFixed(digits);
    return text.startsWith("-") ? (Number(text) === 0 ? text.slice(1) : "−" + text.slice(1)) : text;
  };

  // Three significant digits, without an exponent.
  const short = value => {
    if (!Number.isFinite(value)) return "–";
    const size = Math.abs(value);
    return fixed(value, size >= 100 || size === 0 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
  };

  // A number in the written unit of its data.
  const quantity = (value, name, digits) => {
    const { factor, text, digits: usual } = unit(name);
    if (!Number.isFinite(value)) return "–";
    const number = Number.isFinite(digits ?? usual) ? fixed(value * factor, digits ?? usual) : short(value * factor);
    return text ? `${number} ${text}` : number;
  };

  const duration = seconds => {
    if (!Number.isFinite(seconds)) return "–";
    if (seconds < 60) return `${fixed(seconds, 1)} s`;
    return `${Math.floor(seconds / 60)} min ${fixed(seconds % 60, 0)} s`;
  };
  const distance = metres => {
    if (!Number.isFinite(metres)) return "–";
    return Math.abs(metres) < 1000 ? `${fixed(metres, 0)} m` : `${fixed(metres / 1000, 2)} km`;
  };

  const capital = text => text.charAt(0).toUpperCase() + text.slice(1);

  // The three states of a limit. Each has a sign and a word, so that none depends on its colour.
  const STATES = {
    within: { sign: "✓", word: "within limits" },
    near: { sign: "▲", word: "near the limit" },
    over: { sign: "✕", word: "over the limit" },
  };
  const state = share => (share > 1 ? "over" : share > 0.8 ? "near" : "within");

  Object.assign(live, { words: { unit, fixed, short, quantity, duration, distance, capital, STATES, state } });
}
