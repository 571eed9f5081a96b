// Health: what is wrong in words, and the numbers of the last minute.
import { make } from "../make.js";
import { Spark } from "../spark.js";

const $ = (id) => document.getElementById(id);
const MS = 1000, MB = 1e-6, PERCENT = 100;

// id, name, from which message, its number, its factor, digits
const NUMBERS = [
  ["images", "Images per second", "Health", (one) => one.image_rate_hz, 1, 0],
  ["late", "Behind the clock, ms", "Health", (one) => one.late_s, MS, 0],
  ["turn", "Work for one image, ms", "Health", (one) => one.turn_s, MS, 1],
  ["pictures", "Pictures per second", "Health", (one) => one.picture_rate_hz, 1, 0],
  ["shown", "From an image to this page, median ms", "Delivery", (one) => one.shown_median_s, MS, 0],
  ["shown-p99", "… 99 of 100 within, ms", "Delivery", (one) => one.shown_p99_s, MS, 0],
  ["told", "Messages per second, all pages", "Delivery", (one) => one.told_hz, 1, 0],
  ["missed", "Too late for slow pages, per second", "Delivery", (one) => one.missed_hz, 1, 0],
  ["pages", "Pages", "Delivery", (one) => one.pages, 1, 0],
  ["loss", "Packets lost, worst robot, %", "Health", (one) => one.worst_loss, PERCENT, 1],
  ["battery", "Lowest battery, V", "Health", (one) => one.least_battery_v, 1, 2],
  ["memory", "Memory of the arena, MB", "Health", (one) => one.memory_bytes, MB, 0],
  ["heap", "Memory of this page, MB", "Health", () => performance.memory?.usedJSHeapSize ?? null, MB, 1],
  ["disk", "Disk left for recordings, GB", "Health", (one) => one.disk_free_bytes, 1e-9, 1],
  ["dropped", "Not recorded in time", "Health", (one) => one.dropped_count, 1, 0],
];

export class HealthRoom {
  constructor() {
    this.id = "health";
    this.numbers = NUMBERS.map((one) => new Figure(...one));
    $("health-numbers").replaceChildren(...this.numbers.map((one) => one.element));
  }

  welcome() {}
  lost() { $("health-advice").replaceChildren(make("li", { textContent: "No news: the connection is lost." })); }
  close() { this.isOpen = false; }

  open() {
    this.isOpen = true;
    this.draw();
  }

  take(message) {
    for (const one of this.numbers) one.take(message);
    if (message.type === "Health") this.advise(message);
    if (this.isOpen && message.type === "Health") this.draw();
  }

  advise({ advice, stages }) {
    const lines = advice.length ? advice : ["All is well."];
    const list = $("health-advice");
    list.className = advice.length ? "bad" : "good";
    if (list.dataset.told !== lines.join("\n")) { // said aloud once
      list.dataset.told = lines.join("\n");
      list.replaceChildren(...lines.map((text) => make("li", { textContent: text })));
    }
    $("health-stages").replaceChildren(...stages.map((one) => make("li", {},
      make("span", { className: "name", textContent: `Time ${one.name}` }),
      make("b", { textContent: `${(MS * one.mean_s).toFixed(1)} ms` }))));
  }

  draw() { for (const one of this.numbers) one.draw(); }
}

class Figure {
  constructor(id, name, type, of, factor, digits) {
    Object.assign(this, { type, of, factor, digits });
    this.value = make("output", { id: `health-${id}`, textContent: "–" });
    const canvas = make("canvas", { role: "img", "aria-label": `${name}, the last minute` });
    this.spark = new Spark(canvas);
    this.element = make("li", {}, make("span", { className: "hint", textContent: name }), this.value, canvas);
  }

  take(message) {
    if (message.type !== this.type) return;
    const number = this.of(message);
    const value = number === null ? null : this.factor * number;
    this.value.textContent = value === null ? "–" : value.toFixed(this.digits);
    this.spark.take(value);
  }

  draw() { this.spark.draw(); }
}
