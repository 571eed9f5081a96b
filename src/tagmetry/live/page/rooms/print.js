// Printing: a form that the server's choices make, the sheet as it will be, and its files.
import { make } from "../make.js";

const $ = (id) => document.getElementById(id);
const PAUSE_MS = 250; // after the last key, before the sheet is drawn anew
const LABELS = {
  family: "Family", ids: "Ids, like 0-23,30 or all", size: "Side of a marker's black square",
  columns: "Columns", rows: "Rows", first_id: "Id of the first marker", square: "Side of a square",
  gap: "White between neighbours", pitch: "From row to row", diameter: "Diameter of a disc",
  paper: "Paper, or a size like 210x297mm", orientation: "Orientation",
  margin: "White along the paper's edges", quiet: "Quiet zone, cells",
};

export class PrintRoom {
  constructor() {
    this.id = "print";
    this.choices = null;
    this.number = 1;
    this.asked = 0;
    $("print-kind").addEventListener("change", () => this.showFields());
    $("print-form").addEventListener("input", () => { this.number = 1; this.soon(); });
    $("print-form").addEventListener("submit", (event) => { event.preventDefault(); this.show(); });
    $("print-before").addEventListener("click", () => this.turn(-1));
    $("print-after").addEventListener("click", () => this.turn(1));
  }

  welcome() { if (this.isOpen) this.load(); }
  lost() {}
  take() {}
  close() { this.isOpen = false; }

  open() {
    this.isOpen = true;
    this.load();
  }

  async load() {
    if (this.choices) return;
    const answer = await fetch("/print/choices");
    if (!answer.ok) return this.refuse(await answer.text());
    this.choices = await answer.json();
    const kinds = Object.entries(this.choices.kinds);
    $("print-kind").replaceChildren(...kinds.map(([name, kind]) => new Option(kind.label, name)));
    $("print-papers").replaceChildren(...this.choices.papers.map((name) => new Option(name, name)));
    $("print-paper").replaceChildren(...this.fields(this.choices.paper));
    this.showFields();
  }

  showFields() {
    const { usual } = this.choices.kinds[$("print-kind").value];
    $("print-fields").replaceChildren(...this.fields(usual));
    this.number = 1;
    this.show();
  }

  fields(usual) {
    return Object.entries(usual).map(([name, value]) =>
      make("label", { className: "field" }, LABELS[name], this.control(name, value)));
  }

  control(name, value) {
    if (name === "family") return this.families(value);
    if (name === "orientation") {
      return make("select", { name }, ...["auto", "portrait", "landscape"].map((one) => new Option(one)));
    }
    const list = name === "paper" ? { list: "print-papers" } : {};
    const made = make("input", { name, value, autocomplete: "off", spellcheck: false });
    for (const [key, id] of Object.entries(list)) made.setAttribute(key, id);
    return made;
  }

  families(value) {
    const options = Object.entries(this.choices.families).map(([name, count]) =>
      new Option(`${name} (${count})`, name, name === value, name === value));
    return make("select", { name: "family" }, ...options);
  }

  wishes() { return new URLSearchParams([...new FormData($("print-form")), ["page", this.number]]); }

  soon() {
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => this.show(), PAUSE_MS);
  }

  turn(by) {
    this.number += by;
    this.show();
  }

  async show() {
    const number = ++this.asked, wishes = this.wishes();
    const answer = await fetch(`/print/preview?${wishes}`);
    const told = answer.ok ? await answer.json() : await answer.text();
    if (number !== this.asked) return; // a newer one is on its way
    if (answer.ok) this.accept(told, wishes);
    else this.refuse(told);
  }

  accept(sheet, wishes) {
    this.number = sheet.page;
    $("print-answer").textContent = "";
    $("print-sheet").src = `data:image/svg+xml,${encodeURIComponent(sheet.svg)}`;
    $("print-sheet").alt = sheet.title;
    $("print-sheet").hidden = false;
    const size = [sheet.width_m, sheet.height_m].map((m) => (1000 * m).toFixed(0)).join(" × ");
    $("print-told").textContent =
      `${sheet.title}. Page ${sheet.page} of ${sheet.pages}, ${size} mm.`;
    $("print-before").disabled = sheet.page <= 1;
    $("print-after").disabled = sheet.page >= sheet.pages;
    for (const kind of ["pdf", "svg"]) $(`print-${kind}`).href = `/print/sheet.${kind}?${wishes}`;
    $("print-files").hidden = false;
  }

  refuse(words) {
    $("print-answer").textContent = words;
    $("print-sheet").hidden = $("print-files").hidden = true;
    $("print-told").textContent = "";
    for (const id of ["print-before", "print-after"]) $(id).disabled = true;
  }
}
