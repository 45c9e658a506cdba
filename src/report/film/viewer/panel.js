// Panel with the numbers and curves of one body.

const CURVE = { width: 300, height: 92, left: 52, right: 8, top: 6, bottom: 20 };

// Formats a number with at most three significant digits.
function digits(value) {
  if (!Number.isFinite(value)) return "\u2013";
  return String(Number(value.toPrecision(3))).replace("-", "\u2212");
}

function element(name, attributes = {}, text = "") {
  const made = document.createElement(name);
  Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
  if (text) made.textContent = text;
  return made;
}

// Curve of one quantity of a body over time. `moveTo` shows the time of the picture.
class Curve {
  constructor(name, unit, times, values) {
    const known = values.filter(Number.isFinite);
    this.times = times;
    this.range = [Math.min(0, ...known), Math.max(0, ...known)];
    if (this.range[0] === this.range[1]) this.range[1] = 1;
    const { width, height, left, right, top, bottom } = CURVE;
    const label = `${name} [${unit}]`;
    const word = (kind, x, y, value) => `<text class="tick ${kind}" x="${x}" y="${y}">${digits(value)}</text>`;
    const line = values.flatMap((value, i) => {
      return Number.isFinite(value) ? [`${this.x(times[i]).toFixed(1)} ${this.y(value).toFixed(1)}`] : [];
    });
    this.node = element("figure", { class: "film-curve" });
    this.node.append(element("figcaption", {}, label));
    const holder = element("div");
    holder.innerHTML = `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${label} over time">
      <path class="axis" d="M${left} ${top}V${height - bottom}H${width - right}"/>
      ${this.range.map((value) => word("end", left - 5, this.y(value) + 4, value)).join("")}
      ${word("", left, height - 5, times[0])}${word("end", width - right, height - 5, times[times.length - 1])}
      <path class="line c0" d="M${line.join("L")}"/><path class="mark"/></svg>`;
    this.mark = holder.querySelector(".mark");
    this.node.append(holder);
  }

  x(time) {
    const [first, last] = [this.times[0], this.times[this.times.length - 1]];
    return CURVE.left + (CURVE.width - CURVE.left - CURVE.right) * (time - first) / (last - first || 1);
  }

  y(value) {
    const share = (value - this.range[0]) / (this.range[1] - this.range[0]);
    return CURVE.height - CURVE.bottom - (CURVE.height - CURVE.top - CURVE.bottom) * share;
  }

  moveTo(time) {
    this.mark.setAttribute("d", `M${this.x(time).toFixed(1)} ${CURVE.top}V${CURVE.height - CURVE.bottom}`);
  }
}

class Panel {
  // `bodies` is the part of the film with the units; `choose` is called with the number of the chosen body.
  constructor(bytes, times, bodies, choose) {
    this.bytes = bytes;
    this.times = times;
    this.bodies = bodies;
    this.curves = [];
    this.node = document.getElementById("film-unit");
    this.content = document.getElementById("film-facts");
    this.list = document.getElementById("film-choice");
    this.list.append(element("option", { value: 0 }, "none"));
    bodies.list.forEach(({ number }) => this.list.append(element("option", { value: number }, String(number))));
    this.list.addEventListener("change", () => choose(Number(this.list.value)));
    this.node.hidden = false;
  }

  // Shows facts and curves of a body; number 0 shows none.
  show(number) {
    this.list.value = String(number);
    this.content.replaceChildren();
    this.curves = [];
    const index = this.bodies.list.findIndex((body) => body.number === number);
    if (index < 0) return;
    const facts = element("dl", { class: "film-list" });
    this.bodies.list[index].facts.forEach(([name, value]) => {
      facts.append(element("dt", {}, name), element("dd", {}, value));
    });
    this.content.append(facts);
    const count = this.bodies.list.length;
    this.bodies.fields.filter((field) => field.unit).forEach((field) => {
      const all = numbers(this.bytes, field.values);
      const values = this.times.map((_, frame) => all[frame * count + index]);
      this.curves.push(new Curve(field.name, field.unit, this.times, values));
    });
    this.curves.forEach((curve) => this.content.append(curve.node));
  }

  moveTo(time) {
    this.curves.forEach((curve) => curve.moveTo(time));
  }
}
