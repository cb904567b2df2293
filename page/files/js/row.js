"use strict";
// A row of a table: its first cell is its heading.
{
  const live = (globalThis.live ??= {});

  const row = (texts, isAlarm) => {
    const place = document.createElement("tr");
    if (isAlarm) place.className = "alarm";
    place.append(
      ...texts.map((text, n) =>
        Object.assign(document.createElement(n === 0 ? "th" : "td"), {
          textContent: text,
          ...(n === 0 ? { scope: "row" } : {}),
        }),
      ),
    );
    return place;
  };

  Object.assign(live, { row });
}
