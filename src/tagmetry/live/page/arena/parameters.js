// @ts-check
// The controllers' parameters, each with its range; sent when they are let go.
import { make } from "../make.js";

/** @typedef {import("../messages").LiveParameter} Parameter */

export class Parameters {
  /**
   * @param {HTMLElement} element
   * @param {HTMLElement} hint
   * @param {{ send: Function, commands: boolean }} page
   */
  constructor(element, hint, page) {
    this.element = element;
    this.hint = hint;
    this.page = page;
    /** @type {Map<string, { slider: HTMLInputElement, value: HTMLElement }>} */
    this.sliders = new Map();
  }

  /** @param {Parameter[]} parameters */
  take(parameters) {
    this.hint.hidden = parameters.length > 0;
    if (parameters.map((one) => one.name).join() !== [...this.sliders.keys()].join()) {
      this.sliders.clear();
      this.element.replaceChildren(...parameters.map((one) => this.made(one)));
    }
    for (const one of parameters) this.show(one.name, one.value);
  }

  /** @param {Parameter} one */
  made(one) {
    const slider = make("input", { type: "range", min: one.least, max: one.most,
      step: stepOf(one), disabled: !this.page.commands, "data-operator": "" });
    const value = make("b"); // an output would take the label from the slider
    slider.addEventListener("input", () => { value.textContent = short(Number(slider.value)); });
    slider.addEventListener("change", () =>
      this.page.send("SetParameter", { name: one.name, value: Number(slider.value) }));
    this.sliders.set(one.name, { slider, value });
    return make("label", { className: "field", title: one.meaning },
      make("span", {}, `${one.name}: `, value), slider, make("small", {}, one.meaning));
  }

  /** @param {string} name @param {number} value */
  show(name, value) {
    const known = this.sliders.get(name);
    if (!known) return;
    known.slider.value = String(value);
    known.value.textContent = short(value);
  }
}

// A hundredth of the range or less, as a round number.
function stepOf({ least, most }) { return 10 ** Math.floor(Math.log10((most - least) / 100)); }

function short(value) { return String(Number(value.toPrecision(3))); }
