// Starts the film when the page is loaded. Without WebGL2 or with an old browser, a sentence points to the pictures.

// Longest time of the viewer between two pictures of a film that plays [ms].
const LONGEST_STEP = 100;

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
      // A page in the background does not draw: the film goes on where it was.
      film.advance(Math.min(now - last, LONGEST_STEP) / 1000);
      last = now;
      try {
        film.draw();
        requestAnimationFrame(loop);
      } catch (error) {
        giveUp(error);
      }
    };
    requestAnimationFrame(loop);
  } catch (error) {
    giveUp(error);
  }
}

function giveUp(error) {
  const note = document.getElementById("film-note");
  note.hidden = false;
  note.textContent = `This browser cannot show the film (${error.message}). The pictures below show the same run.`;
  document.getElementById("film").classList.add("film-missing");
}

start();
