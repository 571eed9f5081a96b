// A recording by its time line: asks for one moment at a time, and only ever for the newest wish.
import { parse } from "../link.js";

const STEP_MS = 50;
const JUMP_S = 1; // from here on trails begin anew

export class Player {
  // views.world(message), views.picture(message), views.clear() show; changed() when anything did.
  constructor(views, changed, fail) {
    Object.assign(this, { views, changed, fail, speed: 1 });
    this.shut();
  }

  get isPlaying() { return this.timer !== null; }

  async open(name) {
    this.shut();
    this.name = name;
    const told = await this.ask("length");
    if (this.name !== name || !told) return;
    this.length = (await told.json()).length_s;
    this.seek(0);
    this.play();
  }

  shut() {
    this.pause();
    this.name = this.asked = this.shown = null;
    this.at = this.length = 0;
    this.views.clear();
    this.changed();
  }

  play() {
    if (this.isPlaying || !this.length) return;
    if (this.at >= this.length) this.seek(0);
    let then = performance.now();
    this.timer = setInterval(() => {
      const now = performance.now();
      this.move(this.at + this.speed * (now - then) / 1000);
      then = now;
    }, STEP_MS);
    this.changed();
  }

  pause() {
    clearInterval(this.timer);
    this.timer = null;
    this.changed();
  }

  seek(at) {
    this.move(at);
    if (!this.isPlaying) this.changed();
  }

  move(at) {
    this.at = Math.min(Math.max(at, 0), this.length);
    if (this.at >= this.length) this.pause();
    this.changed();
    this.show();
  }

  // A moment that is wished for while another one is on its way waits, and replaces what waited.
  async show() {
    if (this.busy) return;
    this.busy = true;
    while (this.name !== null && this.asked !== this.at) {
      const { name, at } = this;
      this.asked = at;
      const [world, picture] = await Promise.all([this.ask("world", at), this.ask("picture", at)]);
      if (this.name === name) await this.showMoment(at, world, picture);
    }
    this.busy = false;
  }

  async showMoment(at, world, picture) {
    if (this.shown !== null && (at < this.shown || at > this.shown + JUMP_S * this.speed)) {
      this.views.clear();
    }
    this.shown = at;
    if (world?.status === 200) this.views.world(await world.json());
    if (picture?.status === 200) await this.views.picture(parse(await picture.arrayBuffer()));
  }

  // Returns the answer; null where there is none, and says why.
  async ask(what, at = 0) {
    try {
      const answer = await fetch(`/recordings/${encodeURIComponent(this.name)}/${what}?at=${at}`);
      if (answer.ok) return answer;
      this.fail(await answer.text());
    } catch {
      this.fail("the server does not answer");
    }
    this.pause();
    return null;
  }
}
