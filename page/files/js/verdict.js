"use strict";
// The state in words: a verdict that is spoken when it changes, a summary, health of dampers, and the real-time thread.
{
  const live = (globalThis.live ??= {});
  const { words, bars, frames, vehicle } = live;

  const QUIET_MS = 4000;
  // Readings that are shown.
  const ROWS = 12;
  const by = id => document.getElementById(id);
  const spoken = { text: "", at: -QUIET_MS };
  const pace = { at: 0, time_s: 0, reached: NaN };

  const put = (id, text) => {
    const place = by(id);
    if (place.textContent !== text) place.textContent = text;
  };

  const of = ({ number, side }) => `wheelset ${number + 1}${side ? `, ${side} wheel` : ""}`;
  // Of a wheel or wheelset: the value, the value and its limit, the share of the load.
  const ratio = ({ value }) => `${words.fixed(value, 2)} of ${words.fixed(live.scene.derailment_limit, 2)}`;
  const push = ({ value, set }) =>
    `${words.fixed(Math.abs(value) * 1e-3, 0)} of ${words.quantity(set.lateral_limit_n, "N", 0)}`;
  const load = ({ value, set }) =>
    value <= 0 ? "lifted" : `${words.fixed((100 * value) / set.load_static_n, 0)} % of its load`;
  const SHORT = {
    climbing: found => `${of(found)}: Y/Q ${ratio(found)}`,
    shifting: found => `${of(found)}: lateral force ${push(found)}`,
    unloading: found => `${of(found)}: ${load(found)}`,
  };
  const LONG = {
    climbing: found => `The highest Y/Q is ${ratio(found)}, at ${of(found)}`,
    shifting: found => `The highest lateral force is ${push(found)}, at ${of(found)}`,
    unloading: found => `The least loaded wheel is ${of(found)}, ${found.value <= 0 ? "" : "with "}${load(found)}`,
  };

  function verdict() {
    if (live.sources.isTarget()) return live.target.verdict();
    const found = Object.keys(LONG)
      .map(name => [name, bars.worst(name)])
      .filter(([, worst]) => worst);
    for (const [name, worst] of found) {
      const { sign, word } = words.STATES[worst.state];
      const place = by(`${name}-word`);
      place.dataset.state = worst.state;
      put(`${name}-word`, `${sign} ${name === "unloading" && worst.state === "over" ? "wheel lifted" : word}`);
    }
    const flags = live.histories?.[0]?.newest?.flags ?? 0;
    const rank = { within: 0, near: 1, over: 2 };
    const [name, worst] = found.sort((a, b) => rank[b[1].state] - rank[a[1].state])[0] ?? [];
    if (live.status?.ended) return ["over", `Ended: ${live.status.ended}`];
    const isWithout = live.sources.isRecording() && live.histories?.[0]?.newest;
    if (!worst) return ["within", isWithout ? "The recording has no forces of wheels" : "Not started"];
    if (worst.state === "within") return ["within", "All wheels are within their limits"];
    const sentence = words.capital(SHORT[name](worst));
    return [worst.state, flags & frames.FLAGS.invalid ? `${sentence}; outside the validity of the model` : sentence];
  }

  // Tells a screen reader of a change, but not more often than it can be heard.
  function speak([state, text], now) {
    const place = by("verdict");
    place.dataset.state = state;
    put("verdict-text", `${words.STATES[state].sign} ${text}`);
    const heard = state === "within" ? text : `${words.STATES[state].word}. ${text}`;
    const subject = `${state} ${text.replace(/[\d.,]+/g, "")}`;
    if (subject === spoken.text || now - spoken.at < QUIET_MS) return;
    Object.assign(spoken, { text: subject, at: now });
    put("spoken", heard);
  }

  function summary() {
    if (live.sources.isTarget()) return live.target.summary();
    const history = live.histories[0];
    const swings = live.scene.wheelsets.map(set => {
      const [least, greatest] = history.range(live.index.get(set.slug + "_lateral_m"), 2);
      return greatest - least;
    });
    const most = swings.reduce((best, swing, n) => (swings[best] >= swing ? best : n), 0);
    const sentences = [
      `${words.capital(live.scene.vehicle)}, ${words.fixed(vehicle.speed() * 3.6, 0)} km/h.`,
      `${words.capital(vehicle.courseInWords(vehicle.distance()))}.`,
    ];
    if (Number.isFinite(swings[most]))
      sentences.push(
        `In the last 2 s wheelset ${most + 1} swings most from side to side: ${words.quantity(swings[most], "m", 1)}.`,
      );
    for (const name of Object.keys(LONG)) {
      const worst = bars.worst(name);
      if (worst) sentences.push(`${words.capital(LONG[name](worst))}: ${words.STATES[worst.state].word}.`);
    }
    if (live.sources.isRecording()) return put("summary", sentences.join(" "));
    const worn = live.scene.dampers.filter((_, number) => vehicle.changed(number));
    sentences.push(
      worn.length === 0 ? "All dampers are as new." : `Not as new: ${worn.map(({ name }) => name).join(", ")}.`,
    );
    put("summary", sentences.join(" "));
  }

  // Alarms first, then the chosen dampers; all others are good or unknown.
  function health({ readings }) {
    const chosen = live.view.dampers.map(number => live.scene.dampers[number]?.name);
    const isAlarm = ({ alarm }) => alarm;
    const shown = [
      ...readings.filter(isAlarm),
      ...readings.filter(reading => !isAlarm(reading) && chosen.includes(reading.damper)),
    ].slice(0, ROWS);
    const rows = shown.map(({ damper, label, value, low, high, unit, alarm, trusted }) => {
      const { factor, text: written, digits } = words.unit(unit);
      const [middle, least, most] = [value, low, high].map(number => words.fixed(number * factor, digits));
      const cells = [
        `${words.capital(damper)}, ${label}`,
        `${middle} ${written}`.trim() + ` (${least} to ${most})`,
        (alarm ? "▲ alarm" : "✓ good") + (trusted === false ? ", unsure" : ""),
      ];
      return live.row(cells, alarm);
    });
    by("health-rows").replaceChildren(...rows);
    // A source without health has no place for it.
    if (rows.length > 0) by("health-table").closest(".card").classList.remove("elsewhere");
    by("health-none").hidden = rows.length > 0;
    by("health-table").hidden = rows.length === 0;
    const alarms = readings.filter(isAlarm).length;
    put("health-word", alarms ? `▲ ${alarms} alarm${alarms > 1 ? "s" : ""}` : "");
  }

  // Reached factor of real time, from simulated time against the clock.
  function measurePace(now) {
    const newest = live.histories?.[0]?.newest;
    if (!newest) return;
    // What is before the time to which a recording went came in a burst.
    if (newest.time_s < pace.time_s || live.replay.isBehind()) Object.assign(pace, { at: now, time_s: newest.time_s });
    if (now - pace.at < 900) return;
    if (pace.at > 0) pace.reached = (1000 * (newest.time_s - pace.time_s)) / (now - pace.at);
    Object.assign(pace, { at: now, time_s: newest.time_s });
  }

  function timing(now) {
    measurePace(now);
    const newest = live.histories?.[0]?.newest;
    const wanted = live.status?.factor ?? 0;
    const reached = Number.isFinite(pace.reached) ? `${words.fixed(pace.reached, 2)} times real time` : "–";
    put("reached", wanted === 0 ? "paused" : reached);
    put("slower", newest && newest.flags & frames.FLAGS.slow ? "▲ slower than wanted" : "");
    const { mean_ms, greatest_ms, frames: count } = live.timing;
    const page = `${words.fixed(mean_ms, 1)} ms of script a frame, at most ${words.fixed(greatest_ms, 1)} ms`;
    put("page-timing", `This page: ${page} in ${count} frames.`);
    if (!newest || !(newest.work_us > 0)) return;
    const tick = 1e6 * live.scene.step_s;
    put("work-mean", `${words.short(newest.work_us)} µs`);
    put("work-most", `${words.short(newest.greatest_us)} µs`);
    put(
      "work-share",
      `${words.fixed((100 * newest.work_us) / tick, 1)} % of the ${words.short(tick / 1000)} ms of a tick.`,
    );
    by("work-bar").value = Math.min(1, newest.work_us / tick);
  }

  function readouts() {
    const newest = live.histories?.[0]?.newest;
    const isKnown = !live.sources.isRecording() || Number.isFinite(newest?.distance_m) || live.status?.speed_km_h > 0;
    put("speed-now", isKnown ? words.fixed(vehicle.speed() * 3.6, 0) : "–");
    put("time-now", newest ? words.duration(newest.time_s) : "0.0 s");
    put("distance-now", newest ? words.distance(newest.distance_m) : words.distance(vehicle.distance()));
  }

  // Called a few times a second.
  function write(now) {
    bars.measure();
    speak(verdict(), now);
    readouts();
    timing(now);
  }

  Object.assign(live, {
    verdict: { write, summary, health, put, restart: () => Object.assign(pace, { at: 0, time_s: 0, reached: NaN }) },
  });
}
