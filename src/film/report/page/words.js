// What is said, and how numbers are written.

const facts = JSON.parse(document.getElementById("facts").textContent);

/** An element with attributes and children; texts are texts, never markup. */
function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false && value != null) element.setAttribute(key, value);
  }
  element.append(...children.flat().filter((child) => child != null));
  return element;
}

/** The same in SVG. */
function draw(name, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children.flat());
  return element;
}

/** Four digits, or a power of ten. */
function short(x) {
  if (x == null || Number.isNaN(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e6 || size < 1e-4) {
    const power = Math.floor(Math.log10(size));
    const digits = (x / 10 ** power).toPrecision(3).replace(/\.?0+$/, "");
    return minus(digits === "1" ? `10${raised(power)}` : `${digits} · 10${raised(power)}`);
  }
  return minus(Number.isInteger(x) ? String(x) : x.toPrecision(4).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, ""));
}

function raised(power) {
  return [...String(power)].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c])).join("");
}

function minus(text) {
  return text.replace(/^-/, "−");
}

/** A ratio as people read it. */
function percent(x) {
  return x == null ? "–" : `${short(100 * x)} %`;
}

/** A count with its noun. */
function counted(count, one, many = `${one}s`) {
  return `${count.toLocaleString("en").replaceAll(",", " ")} ${count === 1 ? one : many}`;
}

/** A text in which names of keys stand between backquotes. */
function marked(text) {
  return text.split("`").map((part, k) => (k % 2 === 1 ? make("code", {}, part) : part));
}

/** sRGB of linear light, as CSS has it. */
function css(linear) {
  const byte = (x) => {
    const value = Math.min(1, Math.max(0, x));
    return Math.round(255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055));
  };
  return `rgb(${linear.map(byte).join(" ")})`;
}

/** A button that copies a text. */
function copy(what) {
  return make("button", { type: "button", class: "copy", onclick: (event) => {
    navigator.clipboard?.writeText(what).then(() => { event.target.textContent = "copied"; }, () => { event.target.textContent = "select it and copy"; });
  } }, "copy");
}

/** On paper all is open that can be opened. */
function openOnPaper() {
  let closed = [];
  addEventListener("beforeprint", () => {
    closed = [...document.querySelectorAll("details:not([open])")];
    closed.forEach((details) => { details.open = true; });
  });
  addEventListener("afterprint", () => closed.forEach((details) => { details.open = false; }));
}
