"use strict";
// A quantity that one changes: a slider with a number field. A value may not be known; then the slider waits for one.
{
  const live = (globalThis.live ??= {});
  const { words } = live;

  // A logarithmic slider that starts at zero has this many decades above zero.
  const DECADES = 4;

  const isKnown = value => Number.isFinite(value ?? NaN);

  // Position of a slider from 0 to 1000, and the value there.
  function scale({ min, max, is_logarithmic: isLogarithmic }) {
    const low = isLogarithmic && min <= 0 ? max / 10 ** DECADES : min;
    const toValue = isLogarithmic
      ? part => (Number(part) === 0 ? min : low * (max / low) ** (part / 1000))
      : part => min + (part / 1000) * (max - min);
    const toPart = isLogarithmic
      ? value => (value <= low ? 0 : (1000 * Math.log(value / low)) / Math.log(max / low))
      : value => (1000 * (value - min)) / (max - min);
    return { toValue, toPart };
  }

  // Makes the row of a quantity. `change(value)` is called with each new value in the unit of the data; `origin` says
  // what the first value is, such as "as new".
  function row(quantity, origin, change) {
    const { factor, text: unit } = words.unit(quantity.unit);
    const { toValue, toPart } = scale(quantity);
    const place = document.getElementById("quantity").content.firstElementChild.cloneNode(true);
    const [label, range, number, unitPlace, usual] = [
      ".name",
      "input[type=range]",
      "input[type=number]",
      ".unit",
      ".usual",
    ].map(name => place.querySelector(name));
    label.textContent = words.capital(quantity.label);
    range.setAttribute("aria-label", `${quantity.label}, slider`);
    number.setAttribute("aria-label", `${quantity.label}${unit ? `, ${unit}` : ""}`);
    range.dataset.key = quantity.key;
    Object.assign(number, { min: quantity.min * factor, max: quantity.max * factor, step: "any" });
    unitPlace.textContent = unit;
    const first = isKnown(quantity.value) ? `${words.short(quantity.value * factor)} ${unit}`.trim() : "not known";
    usual.textContent = `${origin} ${first}`;
    const send = value => {
      know(true);
      change(Number((value / factor).toPrecision(5)));
    };
    live.controls.pair(range, number, send, {
      toValue: part => toValue(part) * factor,
      toPart: value => toPart(value / factor),
    });
    const tell = () =>
      range.setAttribute("aria-valuetext", number.value === "" ? "not known" : `${number.value} ${unit}`.trim());
    range.addEventListener("input", tell);
    const know = isThere => {
      range.disabled = number.disabled || !isThere;
      range.toggleAttribute("data-unknown", !isThere);
      number.placeholder = isThere ? "" : "not known";
    };
    const show = (value, isForced = false) => {
      if ([range, number].includes(document.activeElement) && !isForced) return;
      const isThere = isKnown(value);
      know(isThere);
      number.value = isThere ? Number((value * factor).toPrecision(3)) : "";
      range.value = isThere ? toPart(value) : 0;
      tell();
      const isChanged = isThere && Math.abs(value - (quantity.value ?? value)) > 1e-6 * Math.abs(quantity.max);
      place.classList.toggle("changed", isChanged);
    };
    show(quantity.value, true);
    return { place, key: quantity.key, show };
  }

  Object.assign(live, { quantity: { row } });
}
