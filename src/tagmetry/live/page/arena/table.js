// @ts-check
// One line for each robot. Names are only ever set as text.
export class RobotTable {
  constructor(body, onSelect) {
    this.body = body;
    this.onSelect = onSelect;
    this.rows = new Map();
  }

  clear() { this.body.replaceChildren(); this.rows.clear(); }

  take(world, selected) {
    for (const id of [...this.rows.keys()]) {
      if (!world.robots.some((one) => one.id === id)) {
        this.rows.get(id).line.remove();
        this.rows.delete(id);
      }
    }
    for (const one of world.robots) this.show(one, selected);
  }

  show(one, selected) {
    const { line, cells, button } = this.rows.get(one.id) ?? this.add(one);
    line.className = one.id === selected ? "selected" : "";
    button.setAttribute("aria-pressed", String(one.id === selected));
    put(button, one.name);
    const [state, kind] = stateOf(one);
    put(cells[0], state);
    cells[0].className = `state ${kind}`;
    const numbers = [
      [1000 * one.age_s, 0], [one.speed_mps, 2], [one.ellipse[0] && 1000 * one.ellipse[0], 2],
      [one.battery_v, 2], [100 * one.loss, 1], [one.round_trip_s && 1000 * one.round_trip_s, 1],
    ];
    numbers.forEach(([value, digits], n) => put(cells[n + 1], number(value, digits)));
  }

  add(one) {
    const line = document.createElement("tr"), first = document.createElement("td");
    const button = document.createElement("button");
    button.type = "button";
    button.addEventListener("click", () => this.onSelect(one.id));
    first.append(button);
    const cells = Array.from({ length: 7 }, () => document.createElement("td"));
    line.append(first, ...cells);
    this.body.append(line);
    const row = { line, cells, button };
    this.rows.set(one.id, row);
    return row;
  }
}

function stateOf(one) {
  if (one.is_stopped) return [`stopped: ${one.why}`, "bad"];
  if (!one.is_seen) return ["not seen", "warn"];
  const tasks = { own: "drives", visit: "sent by hand", walk: "on a path", wait: "waits" };
  return [tasks[one.task], one.task === "wait" ? "warn" : "good"];
}

function number(value, digits) {
  return value === null ? "–" : value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1");
}

function put(element, text) {
  if (element.textContent !== text) element.textContent = text;
}
