"use strict";
// Of every chart that carries its points: the value of the one nearest to the pointer, or reached with the arrow keys.
for (const figure of document.querySelectorAll("figure.chart")) {
  const svg = figure.querySelector("svg"), told = figure.querySelector("output");
  const { x, y, frame: [left, top, right, bottom], range: [x0, y1, x1, y0], logarithmic, lines } =
    JSON.parse(figure.querySelector("script").textContent);
  const [across, up] = logarithmic.map(yes => yes ? Math.log10 : u => u);
  const points = lines.flatMap(({ name, points }) => points.map(([u, v]) => ({
    text: `${name}: ${x} ${+u.toPrecision(5)}, ${y} ${+v.toPrecision(5)}`,
    at: [left + (across(u) - x0) / (x1 - x0) * (right - left), bottom + (up(v) - y0) / (y1 - y0) * (top - bottom)],
  })));
  if (!points.length) continue;
  const ring = document.createElementNS(svg.namespaceURI, "circle");
  ring.setAttribute("class", "here");
  ring.setAttribute("r", 56);
  let here = 0;
  const show = i => {
    here = (i + points.length) % points.length;
    ring.setAttribute("cx", points[here].at[0]);
    ring.setAttribute("cy", points[here].at[1]);
    svg.append(ring);
    told.textContent = points[here].text;
  };
  const point = event => {
    const { x: u, y: v } = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    const far = i => Math.hypot(points[i].at[0] - u, points[i].at[1] - v);
    show(points.reduce((best, _, i) => far(i) < far(best) ? i : best, 0));
  };
  svg.addEventListener("pointermove", point);
  svg.addEventListener("pointerdown", point);
  svg.tabIndex = 0;
  svg.addEventListener("keydown", event => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step) { event.preventDefault(); show(here + step); }
  });
  if (figure === document.querySelector("figure.chart")) told.textContent = "Point at a curve, or walk along it with the arrow keys, to read its values.";
}
