// Starts the page, and checks it for tests (report.html#check).
function fitToWindow() {
  for (const plot of timePlots) {
    plot.setSize({width: plot.root.parentElement.clientWidth - 26, height: plot.height});
  }
  if (!pathPlot) return;
  pathPlot.setSize({width: byId("path").clientWidth, height: pathPlot.height});
  view = null;
  applyView(pathPlot);
}

function isDrawn({ctx, bbox}) {
  const {data: pixels} = ctx.getImageData(bbox.left, bbox.top, bbox.width, bbox.height);
  let coloured = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    const [r, g, b, a] = [pixels[i], pixels[i + 1], pixels[i + 2], pixels[i + 3]];
    if (a > 100 && Math.max(r, g, b) - Math.min(r, g, b) > 60) ++coloured;
  }
  return coloured > 20;
}

// Says on the document how many plots there are, how many have ink on them, how many follow the
// pointer on the path, and how many a zoom of one.
function checkPage() {
  const said = document.documentElement.dataset;
  const plots = pathPlot ? [pathPlot, ...timePlots] : timePlots;
  said.plots = plots.length;
  said.drawn = plots.filter(isDrawn).length;
  if (pathPlot) {
    pointAt(pathPlot, pathPlot.over.clientWidth / 2, pathPlot.over.clientHeight / 2);
    said.pointed = timePlots.filter(plot => plot.cursor.left > 0).length;
    said.here = shownRuns()[0].here.style.display;
  }
  const [low, high] = wholeTime(), middle = (low + high) / 2;
  if (timePlots.length) timePlots[0].setScale("x", {min: low, max: middle});
  setTimeout(() => {
    said.zoomed = timePlots.filter(plot => Math.abs(plot.scales.x.max - middle) < 1e-6).length;
    said.checked = "yes";
  }, 200);
}

const isOwnTime = useOneClock();
useOneFrame();
showTexts(isOwnTime);
timeRange = wholeTime();
addTimePlots();
setTime(...timeRange);
if (runs.some(hasPath)) addPathPlot(); else byId("above").remove();
addEventListener("resize", fitToWindow);
if (location.hash === "#check") setTimeout(checkPage, 200);
