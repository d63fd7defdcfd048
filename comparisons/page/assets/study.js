// A page without a picture that moves.

startTheme(() => {});
document.documentElement.dataset.ready = "true";
