// Recordings: begin and end one, fetch, delete, and see one again by its time line.
import { CameraView } from "../arena/camera.js";
import { make } from "../make.js";
import { ArenaMap } from "../arena/map.js";
import { Player } from "../recordings/player.js";

const $ = (id) => document.getElementById(id);
const SURE_MS = 4000; // within which a deletion is asked for again

export class RecordingsRoom {
  constructor(page) {
    this.id = "recordings";
    this.page = page;
    this.recording = null;
    this.map = new ArenaMap($("replay-map"), () => {});
    this.camera = new CameraView($("replay-camera"));
    this.player = new Player(this.views(), () => this.showPlayer(), (why) => this.say(why));
    this.listen();
  }

  views() {
    return {
      world: (message) => {
        this.map.take(message);
        $("replay-told").textContent = `${message.time_s.toFixed(2)} s in the arena's clock · ` +
          (message.is_stopped ? `all stopped: ${message.why}` : `${message.robots.length} robots`);
      },
      picture: (message) => { this.camera.clear(); return this.camera.take(message); },
      clear: () => { this.map.clear(); this.camera.clear(); },
    };
  }

  listen() {
    const { page, player } = this;
    $("recordings-record").addEventListener("click", () =>
      page.send(this.recording ? "StopRecording" : "StartRecording"));
    $("replay-play").addEventListener("click", () => (player.isPlaying ? player.pause() : player.play()));
    $("replay-time").addEventListener("input", (event) => player.seek(Number(event.target.value)));
    $("replay-speed").addEventListener("change", (event) => { player.speed = Number(event.target.value); });
    $("replay-leave").addEventListener("click", () => player.shut());
  }

  open() { this.isOpen = true; this.load(); }
  close() { this.isOpen = false; this.player.shut(); }
  lost() { this.player.pause(); }

  welcome(message) {
    this.map.half = message.floor_m;
    this.load();
  }

  take(message) {
    if (message.type !== "Health" || message.recording === this.recording) return;
    this.recording = message.recording;
    $("recordings-record").textContent = this.recording ? "End recording" : "Record";
    $("recordings-record").setAttribute("aria-pressed", String(Boolean(this.recording)));
    this.load();
  }

  async load() {
    if (!this.isOpen) return;
    if (!this.page.commands) return this.say("Recordings are the operator's: sign in above.");
    const answer = await fetch("/recordings");
    if (!answer.ok) return this.say(await answer.text());
    const found = await answer.json();
    this.say(found.length ? "" : "Nothing has been recorded yet. Record, drive, end it, and see it again here.");
    $("recordings-list").replaceChildren(...found.map((one) => this.line(one)));
  }

  line(one) {
    const size = one.is_growing ? "being written" : `${(one.size_bytes / 1e6).toFixed(1)} MB`;
    const play = make("button", { type: "button", textContent: "See again", disabled: one.is_growing });
    play.addEventListener("click", () => this.player.open(one.name));
    const fetched = make("a", { className: "button", href: `/recordings/${encodeURIComponent(one.name)}`,
      download: one.name, textContent: "Download" });
    const gone = make("button", { type: "button", textContent: "Delete", disabled: one.is_growing });
    gone.addEventListener("click", () => this.remove(one.name, gone));
    const named = make("span", { className: "name", textContent: one.name });
    return make("li", {}, named, make("span", { className: "hint", textContent: size }), play, fetched, gone);
  }

  // The first click asks, the second one within some seconds deletes.
  async remove(name, button) {
    if (!button.dataset.asked) {
      button.dataset.asked = "yes";
      button.textContent = "Really delete?";
      setTimeout(() => { delete button.dataset.asked; button.textContent = "Delete"; }, SURE_MS);
      return;
    }
    if (this.player.name === name) this.player.shut();
    const answer = await fetch(`/recordings/${encodeURIComponent(name)}/delete`, { method: "POST" });
    await this.load();
    if (!answer.ok) this.say(await answer.text());
  }

  say(text) { $("recordings-say").textContent = text; }

  showPlayer() {
    const { player } = this, isOpen = Boolean(player?.name);
    $("replay").hidden = !isOpen;
    if (!isOpen) return;
    $("replay-name").textContent = player.name;
    $("replay-play").textContent = player.isPlaying ? "Pause" : "Play";
    $("replay-time").max = player.length;
    $("replay-time").value = player.at;
    $("replay-at").textContent = `${player.at.toFixed(1)} of ${player.length.toFixed(1)} s`;
  }
}
