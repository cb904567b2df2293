"use strict";
// Legend entries that hide and show their curves. The axes keep their ranges, so that curves stay where they were.
const connectLegend = panel => {
  for (const button of panel.head.querySelectorAll("li button")) {
    button.addEventListener("click", () => {
      const isShown = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", isShown);
      for (const place of button.dataset.curves.split(" ")) panel.curves[place].isHidden = !isShown;
      panel.u.redraw();
    });
  }
};
