// Light and dark, on every page.

function isDark() {
  return document.documentElement.dataset.theme === "dark";
}

/** Follow the system's choice of light or dark until the button is used; call `redraw` on each change. */
function startTheme(redraw) {
  const button = document.getElementById("theme-toggle");
  const system = matchMedia("(prefers-color-scheme: dark)");
  let chosen = false;
  const apply = (dark) => {
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    button.textContent = dark ? "Light" : "Dark";
    redraw();
  };
  button.addEventListener("click", () => { chosen = true; apply(!isDark()); });
  system.addEventListener("change", (event) => { if (!chosen) apply(event.matches); });
  apply(system.matches);
}
