// Colours of the current theme: everything drawn takes its colours from here or from the style sheet.

const COLOUR_LEVELS = 64;

/** Value of a style sheet variable such as "--ink". */
function themed(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** The concentration scale as CSS colours, index 0 for c = 0 to COLOUR_LEVELS for c = 1. */
function concentrationColours() {
  const stops = report.concentrationStops[isDark() ? 1 : 0].map((hex) =>
    [1, 3, 5].map((start) => parseInt(hex.slice(start, start + 2), 16)));
  return Array.from({ length: COLOUR_LEVELS + 1 }, (_, level) => {
    const position = (level / COLOUR_LEVELS) * (stops.length - 1);
    const first = Math.min(Math.floor(position), stops.length - 2);
    const mixed = stops[first].map((channel, i) => channel + (position - first) * (stops[first + 1][i] - channel));
    return `rgb(${mixed.map(Math.round).join(" ")})`;
  });
}
