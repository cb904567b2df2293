"use strict";
// A button that saves the numbers of a plot as CSV. The text is made here, and the page's policy allows no request.
const offerNumbers = panel => {
  const cell = text => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  // The numbers are 32-bit, which have seven digits.
  const number = value => (value === undefined || Number.isNaN(value) ? "" : String(Number(value.toPrecision(7))));

  // Curves with the same abscissas share a column of them. Marks are abscissas only.
  function columns() {
    const found = new Map();
    const marks = panel.curves.filter(({ stroke }) => stroke === "marks");
    panel.curves.forEach(({ name, stroke, columns: [xs, lows, highs] }, index) => {
      if (stroke === "marks") return;
      if (!found.has(xs)) found.set(xs, []);
      const curve = name || (panel.curves.length > 1 ? `curve ${index + 1}` : "");
      const label = [curve, panel.y.label].filter(Boolean).join(": ");
      found.get(xs).push(...(highs ? [[`${label}, low`, lows], [`${label}, high`, highs]] : [[label, lows]]));
    });
    const all = [...found].flatMap(([xs, ordinates]) => [[panel.x.label, xs], ...ordinates]);
    return [...all, ...marks.map(({ name, columns: [xs] }) => [`${name}: ${panel.x.label}`, xs])];
  }

  function csv() {
    const all = columns();
    const count = Math.max(...all.map(([, values]) => values.length));
    const lines = [all.map(([label]) => cell(label))];
    for (let i = 0; i < count; i++) lines.push(all.map(([, values]) => number(values[i])));
    return lines.map(line => `${line.join(",")}\n`).join("");
  }

  // The heading above the figure and the title of the panel, as a file name.
  function fileName() {
    let above = panel.plot.closest("figure");
    while (above && !/^H[1-6]$/.test(above.tagName)) above = above.previousElementSibling;
    const words = `${above?.textContent ?? ""} ${panel.head.querySelector("b").textContent}`.toLowerCase();
    return `${words.replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "")}.csv`;
  }

  panel.head.querySelector(".data").addEventListener("click", () => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([csv()], { type: "text/csv" }));
    link.download = fileName();
    link.click();
    // The browser reads the blob after the click.
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  });
};
