'use strict';
// What the page's scripts share. They are one script element, in this order:
// elements.js, ladder.js, timing.js, exports.js, page.js.

function html(name, attributes, ...children) {
  return fill(document.createElement(name), attributes, children);
}

function svg(name, attributes, ...children) {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', name),
              attributes, children);
}

function fill(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    element.setAttribute(key, value);
  }
  element.append(...children);
  return element;
}

/** Scrolls a box, not the page. */
function scroll_to(box, side, begin, size) {
  const scroll = `scroll${side}`;
  const extent = side === 'Left' ? box.clientWidth : box.clientHeight;
  if (begin < box[scroll] || begin + size > box[scroll] + extent) {
    box[scroll] = begin - Math.max(0, (extent - size) / 2);
  }
}
