/* The page: what is typed goes to a worker, and its answers into the page. */
const QUESTIONS = ["checked", "drawn", "reported"]; // in the order in which they are asked
const PAUSE = 400; // milliseconds without typing before gark is asked
const LIMIT = 60_000; // for one answer

const at = (id) => document.getElementById(id);
const text = at("text");
let worker, isReady, busy, number = 0, left = [], pause, deadline;

function start() {
  worker?.terminate();
  isReady = busy = false;
  worker = new Worker("worker.js", { type: "module" });
  worker.onmessage = ({ data }) => received(data);
  worker.onerror = (event) => say(`gark does not start: ${event.message}`, "fault");
}

function say(words, sign = "") {
  at("state").textContent = words;
  at("state").className = sign;
}

function ask() {
  number += 1;
  left = [...QUESTIONS];
  next();
}

function next() {
  if (!isReady || busy || !left.length) {
    return;
  }
  const question = left.shift();
  post(question, question === "checked" ? [text.value, columns()] : [text.value]);
}

function post(question, given) {
  busy = true;
  at("stop").disabled = false;
  document.body.dataset.busy = question;
  deadline = setTimeout(() => end(`No answer after ${LIMIT / 1000} seconds`), LIMIT);
  worker.postMessage({ number, question, given });
}

/* how many letters fit into a line of the answer */
function columns() {
  const style = getComputedStyle(at("said"));
  const room = at("said").clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
  return Math.max(30, Math.min(100, Math.floor(room / (0.61 * parseFloat(style.fontSize)))));
}

function end(why) {
  clearTimeout(deadline);
  left = [];
  start();
  say(`${why}: stopped. gark starts anew; change the file to ask again.`, "fault");
  at("stop").disabled = true;
  delete document.body.dataset.busy;
}

function received({ kind, number: of, question, value }) {
  if (kind === "broken") {
    say(`gark does not start: ${value}`, "fault");
    return;
  }
  if (kind === "ready") {
    offer(JSON.parse(value));
    isReady = true;
    if (number) {
      next();
    } else {
      ask();
    }
    return;
  }
  clearTimeout(deadline);
  busy = false;
  if (question === "named" && kind !== "fault") {
    const { text: file, error = "" } = JSON.parse(value);
    at("done").textContent = error;
    if (file !== undefined) {
      text.value = file;
      ask();
      return;
    }
  }
  if (of === number && (question !== "named" || kind === "fault")) {
    show(kind, question, value);
  }
  if (!left.length) {
    at("stop").disabled = true;
    delete document.body.dataset.busy;
  }
  next();
}

const SHOWN = {
  checked(value) {
    const { said, sign, tree } = JSON.parse(value);
    at("said").textContent = said;
    say({ holds: "It holds.", fails: "A claim fails.", open: "A claim is undecided.",
      fault: "The file is no method yet." }[sign], sign);
    fill("tree", tree && `${tree}<figcaption>The first tree that fails.</figcaption>`);
  },
  drawn: (value) => fill("region", value),
  reported(value) {
    at("report").srcdoc = value;
    at("report").hidden = false;
  },
};

function show(kind, question, value) {
  if (kind === "fault") {
    say(`gark failed: ${value}`, "fault");
    return;
  }
  SHOWN[question](value);
}

function fill(id, html) {
  at(id).innerHTML = html; // made by gark, which escapes what the file says
  at(id).hidden = !html;
}

function offer({ families, rules, methods }) {
  if (at("names").children.length) {
    return;
  }
  at("names").append(...methods.map((x) => new Option(x, x)));
  at("rule").append(...rules.map((x) => new Option(x, x)));
  at("colours").dataset.families = JSON.stringify(families);
  addColour("gauss", 2);
  addColour("lobatto-iiia", 3);
  document.querySelectorAll("form [disabled]").forEach((x) => { x.disabled = false; });
}

function addColour(family, stages) {
  const row = document.createElement("div");
  const colour = at("colours").children.length + 1;
  const choice = document.createElement("select");
  const count = document.createElement("input");
  choice.append(...JSON.parse(at("colours").dataset.families).map((x) => new Option(x, x)));
  choice.value = family;
  choice.setAttribute("aria-label", `Family of colour ${colour}`);
  Object.assign(count, { type: "number", min: 1, max: 12, value: stages });
  count.setAttribute("aria-label", `Stages of colour ${colour}`);
  row.className = "row";
  row.append(choice, count);
  at("colours").append(row);
}

function written() {
  const rows = [...at("colours").children].map((row) => {
    const [family, stages] = row.children;
    return `  - {family: ${family.value}, stages: ${stages.value}}\n`;
  });
  const rule = rows.length > 1 ? `transfer: ${at("rule").value}\n` : "";
  return `methods:\n${rows.join("")}${rule}`;
}

async function packed(words) {
  const stream = new Blob([words]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const binary = Array.from(bytes, (x) => String.fromCharCode(x)).join("");
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

async function unpacked(words) {
  const binary = atob(words.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (x) => x.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).text();
}

async function read() {
  const found = /^#file=([\w-]+)$/.exec(location.hash);
  if (!found) {
    return;
  }
  try {
    text.value = await unpacked(found[1]);
  } catch {
    at("done").textContent = "The link holds no file.";
    return;
  }
  if (number) {
    ask();
  }
}

text.addEventListener("input", () => {
  clearTimeout(pause);
  pause = setTimeout(ask, PAUSE);
});
at("more").addEventListener("click", () => addColour("gauss", 2));
at("fewer").addEventListener("click", () => {
  if (at("colours").children.length > 1) {
    at("colours").lastChild.remove();
  }
});
at("families").addEventListener("submit", (event) => {
  event.preventDefault();
  text.value = written();
  ask();
});
at("catalogue").addEventListener("submit", (event) => {
  event.preventDefault();
  if (!isReady || busy) {
    return;
  }
  left = [];
  post("named", [at("name").value || "rk4"]);
});
at("share").addEventListener("click", async () => {
  history.replaceState(null, "", `#file=${await packed(text.value)}`);
  try {
    await navigator.clipboard.writeText(location.href);
    at("done").textContent = "The link is copied; it holds the file.";
  } catch {
    at("done").textContent = "The address of this page now holds the file.";
  }
});
at("save").addEventListener("click", () => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text.value], { type: "application/yaml" }));
  link.download = "method.gark.yaml";
  link.click();
  URL.revokeObjectURL(link.href);
});
at("stop").addEventListener("click", () => end("Stopped"));
addEventListener("hashchange", read);
await read();
start();
