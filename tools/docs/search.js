// Search of the documentation: its index is a script beside the pages, which is loaded with the first letter.
"use strict";

const form = document.querySelector("form[role=search]");
const field = form.querySelector("input");
const list = form.querySelector("ol");
const most = 12;
let index = null;

function loadIndex() {
  index ??= new Promise((done) => {
    const script = document.createElement("script");
    script.src = form.dataset.root + "search-index.js";
    script.onload = () => done(pages); // eslint-disable-line no-undef
    document.head.append(script);
  });
  return index;
}

// A section with all words: those in its heading count most, then those in the page's title.
function score(words, [, , title, heading, text]) {
  let sum = 0;
  for (const word of words) {
    const places = [heading, title, text].map((place) => place.toLowerCase().includes(word));
    if (!places.includes(true)) return 0;
    sum += places[0] ? 9 : places[1] ? 4 : 1;
  }
  return sum;
}

function around(text, word) {
  const at = Math.max(0, text.toLowerCase().indexOf(word) - 40);
  return (at > 0 ? "…" : "") + text.slice(at, at + 120) + "…";
}

async function search() {
  const words = field.value.toLowerCase().split(/\s+/).filter((word) => word.length > 1);
  if (words.length === 0) return list.replaceChildren();
  const found = (await loadIndex()).map((entry) => [score(words, entry), entry]).filter(([value]) => value > 0);
  found.sort((a, b) => b[0] - a[0]);
  list.replaceChildren(...found.slice(0, most).map(([, [name, id, title, heading, text]]) => {
    const item = document.createElement("li"), link = document.createElement("a"), more = document.createElement("span");
    link.href = `${form.dataset.root}${name}.html#${id}`;
    link.textContent = heading === title ? title : `${title}: ${heading}`;
    more.textContent = around(text, words[0]);
    item.append(link, more);
    return item;
  }));
  if (found.length === 0) list.innerHTML = "<li>Nothing found.</li>";
}

field.addEventListener("input", search);
form.addEventListener("submit", (event) => {
  event.preventDefault();
  list.querySelector("a")?.click();
});
