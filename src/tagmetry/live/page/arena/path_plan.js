// @ts-check
// A path before it is driven: its points stand in a line of text, to be typed or clicked.
/** @typedef {[number, number]} Point */
const MOST = 40;

export class PathPlan {
  /** @param {HTMLInputElement} input @param {() => void} onChange */
  constructor(input, onChange) {
    this.input = input;
    this.onChange = onChange;
    input.addEventListener("input", () => this.check());
  }

  /** @returns {Point[] | null} null where the text is no path */
  get points() { return parsed(this.input.value); }

  /** @param {number} x @param {number} y */
  add(x, y) {
    const before = this.input.value.trim().replace(/;$/, "");
    const point = `${x.toFixed(2)}, ${y.toFixed(2)}`;
    this.input.value = before ? `${before}; ${point}` : point;
    this.check();
  }

  clear() {
    this.input.value = "";
    this.check();
  }

  check() {
    this.input.setCustomValidity(this.points ? "" : `expected up to ${MOST} places like 0.5, -0.2; 0, 0`);
    this.onChange();
  }
}

/** @param {string} text "0.5, -0.2; 0, 0" @returns {Point[] | null} */
export function parsed(text) {
  const parts = text.split(";").map((part) => part.trim()).filter(Boolean);
  const points = parts.map((part) => part.split(",").map((one) => (one.trim() ? Number(one) : NaN)));
  const isPath = points.every((one) => one.length === 2 && one.every(Number.isFinite));
  return isPath && points.length <= MOST ? /** @type {Point[]} */ (points) : null;
}
