// Elements of the page. Text is only ever put in as text.

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "class") node.className = value;
    else if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined) node.setAttribute(name, String(value));
  }
  node.append(...children.filter((child) => child !== null));
  return node;
}

/** A swatch of an AUV's colour and dashes, drawn as SVG. */
function swatch(theme, auv) {
  const space = "http://www.w3.org/2000/svg";
  const image = document.createElementNS(space, "svg");
  image.setAttribute("viewBox", "0 0 26 8");
  image.setAttribute("class", "swatch");
  image.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(space, "line");
  const set = { x1: 1, y1: 4, x2: 25, y2: 4, stroke: auvColour(theme, auv), "stroke-width": 4 };
  Object.entries(set).forEach(([name, value]) => line.setAttribute(name, value));
  const dash = auvDash(theme, auv);
  if (dash.length) line.setAttribute("stroke-dasharray", dash.join(" "));
  image.append(line);
  return image;
}
