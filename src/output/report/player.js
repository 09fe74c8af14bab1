// Takes the animation over from its CSS: play, pause, scrub. Without scripts it plays by itself.
document.querySelectorAll("figure").forEach(figure => {
  const frames = [...figure.querySelectorAll(".asperity-frame")];
  const player = figure.querySelector(".player");
  if (frames.length < 2 || !player) return;
  const [button, slider] = [player.querySelector("button"), player.querySelector("input")];
  let now = 0, timer = null;
  const show = k => {
    frames[now].classList.remove("now");
    now = k;
    frames[now].classList.add("now");
    slider.value = now;
  };
  const play = on => {
    clearInterval(timer);
    timer = on ? setInterval(() => show((now + 1) % frames.length), 120) : null;
    button.textContent = on ? "Pause" : "Play";
  };
  slider.max = frames.length - 1;
  slider.addEventListener("input", () => { play(false); show(Number(slider.value)); });
  button.addEventListener("click", () => play(!timer));
  figure.classList.add("taken-over");
  player.hidden = false;
  const still = frames.findIndex(frame => frame.classList.contains("asperity-still"));
  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  show(calm ? Math.max(still, 0) : 0);
  play(!calm);
});
