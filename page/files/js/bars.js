"use strict";
// Bars of every wheel and wheelset against its limit. A thin mark holds the greatest of the last seconds.
{
  const live = (globalThis.live ??= {});
  const { paint, words, frames } = live;

  const HOLD_S = 3;
  const ROW_PX = 27;
  const [LEFT, RIGHT, TOP] = [18, 62, 20];
  const SIDES = ["left", "right"];

  // The limits are for forces that are filtered and averaged over 2 m; a source without them gives the forces.
  const filtered = (start, name) =>
    live.index.has(`${start}_filtered_${name}`) ? `${start}_filtered_${name}` : `${start}_${name}`;

  // Share of its limit that a value reaches; its word follows from it.
  const KINDS = {
    climbing: {
      most: 1.4,
      signals: set => SIDES.map(side => filtered(`${set.slug}_${side}`, "derailment")),
      share: value => Math.max(0, value) / live.scene.derailment_limit,
      write: value => words.fixed(Math.max(0, value), 2),
      worst: ([, greatest]) => greatest,
    },
    shifting: {
      most: 1.4,
      signals: set => [filtered(set.slug, "lateral_force_n")],
      share: (value, set) => Math.abs(value) / set.lateral_limit_n,
      write: value => words.fixed(Math.abs(value) * 1e-3, 0) + " kN",
      worst: ([least, greatest]) => (-least > greatest ? least : greatest),
    },
    unloading: {
      most: 2,
      signals: set => SIDES.map(side => `${set.slug}_${side}_load_n`),
      // Unloading: 1 is a lifted wheel. The usual limit in service is 0.6.
      share: (value, set) => 1 - value / set.load_static_n,
      write: value => words.fixed(Math.max(0, value) * 1e-3, 0) + " kN",
      worst: ([least]) => least,
    },
  };

  // Greatest values of the last seconds, by kind, wheelset and side.
  const held = new Map();
  function measure() {
    for (const [name, kind] of Object.entries(KINDS)) {
      const rows = live.scene.wheelsets.map(set =>
        kind.signals(set).map(signal => {
          const range = live.histories[0].range(live.index.get(signal), HOLD_S);
          const value = kind.worst(range);
          return { value: Number.isFinite(value) ? value : NaN, set, signal };
        }),
      );
      held.set(name, rows);
    }
  }

  const stateOf = (name, value, set) => {
    if (!Number.isFinite(value)) return "within";
    if (name !== "unloading") return words.state(KINDS[name].share(value, set));
    return value <= 0 ? "over" : KINDS[name].share(value, set) > 0.6 ? "near" : "within";
  };

  // The worst wheel or wheelset of a kind.
  function worst(name) {
    const kind = KINDS[name];
    let found = null;
    for (const [number, sides] of (held.get(name) ?? []).entries()) {
      for (const [side, { value, set }] of sides.entries()) {
        const share = kind.share(value, set);
        if (Number.isFinite(share) && !(found?.share >= share))
          found = {
            share,
            value,
            set,
            number,
            side: sides.length > 1 ? SIDES[side] : null,
            state: stateOf(name, value, set),
          };
      }
    }
    return found;
  }

  function draw(name, { context, width }) {
    if (!live.scene || !live.histories) return;
    const kind = KINDS[name];
    const { colours } = paint;
    const length = width - LEFT - RIGHT;
    const sheet =
      name === "unloading"
        ? (value, set) => value / (kind.most * set.load_static_n)
        : (value, set) => kind.share(value, set) / kind.most;
    const x = (value, set) => LEFT + length * Math.max(0, Math.min(1, sheet(value, set)));
    const bottom = TOP + ROW_PX * live.scene.wheelsets.length;
    for (const [number, set] of live.scene.wheelsets.entries()) {
      const top = TOP + number * ROW_PX;
      const isChosen = number === live.view.wheelset;
      paint.text(context, String(number + 1), 4, top + 17, {
        colour: isChosen ? "accent" : "ink",
        weight: 600,
        size: 12.5,
      });
      const signals = kind.signals(set);
      const thick = signals.length > 1 ? 8 : 12;
      for (const [side, signal] of signals.entries()) {
        const y = top + (signals.length > 1 ? 3 + side * 11 : 6);
        const value = frames.reading(signal);
        const hold = held.get(name)?.[number]?.[side]?.value;
        const state = stateOf(name, Number.isFinite(hold) ? hold : value, set);
        context.fillStyle = colours.ground;
        context.fillRect(LEFT, y, length, thick);
        context.fillStyle = colours[state];
        context.globalAlpha = side === 0 && signals.length > 1 ? 0.75 : 1;
        if (Number.isFinite(value)) context.fillRect(LEFT, y, x(value, set) - LEFT, thick);
        context.globalAlpha = 1;
        if (Number.isFinite(hold)) paint.line(context, x(hold, set), y - 1, x(hold, set), y + thick + 1, "ink", 2);
      }
      const worse = (held.get(name)?.[number] ?? []).map(({ value }) => value).filter(Number.isFinite);
      if (worse.length === 0) continue;
      const value = name === "unloading" ? Math.min(...worse) : kind.worst([Math.min(...worse), Math.max(...worse)]);
      const state = stateOf(name, value, set);
      const sign = state === "within" ? "" : words.STATES[state].sign;
      paint.text(context, `${sign}${kind.write(value)}`, width, top + 17, {
        colour: "ink",
        align: "right",
        size: 11.5,
        weight: state === "within" ? 400 : 700,
      });
    }
    const [limit, label] = name === "unloading" ? [LEFT, "lifted"] : [LEFT + length / kind.most, "limit"];
    paint.line(context, limit, TOP - 4, limit, bottom, "over", 2);
    paint.text(context, label, limit + (name === "unloading" ? -1 : 0), 11, {
      colour: "over",
      size: 11.5,
      align: name === "unloading" ? "left" : "center",
    });
    if (name !== "unloading") return;
    const still = LEFT + length / kind.most;
    paint.line(context, still, TOP - 4, still, bottom, "soft", 1, [3, 3]);
    paint.text(context, "at standstill", still, 11, { size: 11.5, align: "center" });
  }

  function start() {
    for (const name of Object.keys(KINDS))
      paint.view(name, {
        height: () => TOP + ROW_PX * (live.scene?.wheelsets.length ?? 6) + 4,
        draw: surface => draw(name, surface),
        period_ms: 96,
      });
  }

  Object.assign(live, { bars: { start, measure, worst, KINDS, held } });
}
