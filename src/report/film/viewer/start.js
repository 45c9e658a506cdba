// Starts the film when the page is loaded. Without WebGL2 or with an old browser, a sentence points to the pictures.

async function start() {
  const note = document.getElementById("film-note");
  try {
    const head = JSON.parse(document.getElementById("film-head").textContent);
    const bytes = await unpack(document.getElementById("film-data").textContent);
    const film = new Film(head, bytes);
    recall(film);
    connect(film);
    note.hidden = true;
    document.getElementById("film").classList.add("film-ready");
    window.breakwaterFilm = film;
    let last = performance.now();
    const loop = (now) => {
      film.advance((now - last) / 1000);
      last = now;
      film.draw();
      requestAnimationFrame(loop);
    };
    requestAnimationFrame(loop);
  } catch (error) {
    note.textContent = `This browser cannot show the film (${error.message}). The pictures below show the same run.`;
    document.getElementById("film").classList.add("film-missing");
  }
}

start();
