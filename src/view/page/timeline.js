// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Play, pause, seek and speed of a recording.
const text = s => `${Math.floor(s / 60)}:${(s % 60).toFixed(1).padStart(4, "0")}`;

export class TimelineBar {
  constructor(send) {
    const [root, play, place, clock, speed] = ["timeline", "play", "place", "clock", "speed"].map(id => document.getElementById(id));
    Object.assign(this, {root, play, place, clock, speed});
    play.addEventListener("click", () => send({play: !this.isPlaying}));
    place.addEventListener("input", () => {
      this.isHeld = true;
      send({seek_s: Number(place.value)});
    });
    place.addEventListener("change", () => { this.isHeld = false; });
    speed.addEventListener("change", () => send({speed: Number(speed.value)}));
    addEventListener("keydown", event => {
      if (event.code !== "Space" || event.target.closest("button, select, input")) return;
      event.preventDefault();
      play.click();
    });
  }

  show({t_s: t, duration_s: duration, speed, playing, seeking}) {
    this.root.hidden = false;
    document.body.classList.add("with-timeline");
    this.isPlaying = playing;
    this.play.textContent = playing ? "pause" : "play";
    this.place.max = duration;
    if (!this.isHeld) this.place.value = t;
    this.clock.textContent = `${text(t)} / ${text(duration)}${seeking ? " …" : ""}`;
    const known = [...this.speed.options].some(option => Number(option.value) === speed);
    if (known) this.speed.value = String(speed);
  }
}
