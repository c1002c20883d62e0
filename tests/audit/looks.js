// What Lighthouse and axe do not measure: text below 12 px, and borders of fields and focus rings
// that differ too little from what is behind them. Returns a sentence for each.
(() => {
  const LEAST_PX = 12;
  const LEAST_CONTRAST = 3;
  const RING_WITHIN = 4; // elements around the focused one that may have the ring
  const canvas = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
  const found = new Set();

  const isShown = (element) => element.checkVisibility({ visibilityProperty: true })
    && element.getBoundingClientRect().width > 1;
  const nameOf = (element) =>
    element.id ? `#${element.id}` : `${element.localName}.${element.className}`;

  /** Ancestors from the element itself to the page. */
  function* around(element) {
    for (let one = element; one; one = one.parentElement) yield one;
  }

  /** Red, green and blue of colours that lie on one another, the lowest first. */
  function blend(colors) {
    canvas.fillStyle = "#fff";
    canvas.fillRect(0, 0, 1, 1);
    for (const color of colors) {
      canvas.fillStyle = color;
      canvas.fillRect(0, 0, 1, 1);
    }
    return [...canvas.getImageData(0, 0, 1, 1).data].slice(0, 3);
  }

  const grounds = (element) =>
    [...around(element)].map((one) => getComputedStyle(one).backgroundColor).reverse();

  function luminance(rgb) {
    const [r, g, b] = rgb.map((value) => value / 255).map(
      (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  }

  /** Contrast of a colour with the ground of an element. */
  function contrast(color, element) {
    const ground = grounds(element);
    const [a, b] = [blend([...ground, color]), blend(ground)].map(luminance);
    return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  }

  function checkTexts() {
    const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {
      const element = texts.currentNode.parentElement;
      const size = parseFloat(getComputedStyle(element).fontSize);
      if (size < LEAST_PX && texts.currentNode.data.trim() && isShown(element)) {
        found.add(`${nameOf(element)}: text of ${size.toFixed(1)} px`);
      }
    }
  }

  function checkFields() {
    const kinds = "input:not([type=range], [type=checkbox], [type=radio], [type=color])";
    for (const field of document.querySelectorAll(`${kinds}, select, textarea`)) {
      if (!isShown(field)) continue;
      const value = contrast(getComputedStyle(field).borderTopColor, field.parentElement);
      if (value < LEAST_CONTRAST) found.add(`${nameOf(field)}: border ${value.toFixed(1)}:1`);
    }
  }

  /** The ring around the focused element: of it, or of what holds it. */
  function ringOf(element) {
    return [...around(element)].slice(0, RING_WITHIN).find((one) => {
      const { outlineStyle, outlineWidth } = getComputedStyle(one);
      return outlineStyle !== "none" && parseFloat(outlineWidth) > 0;
    });
  }

  function checkRings() {
    const reachable = "a[href], button, input, select, textarea, summary, [tabindex='0']";
    for (const element of document.querySelectorAll(reachable)) {
      if (element.disabled || !isShown(element)) continue;
      element.focus({ preventScroll: true });
      if (!element.matches(":focus-visible")) continue;
      const ring = ringOf(element);
      if (!ring) {
        found.add(`${nameOf(element)}: no focus ring`);
        continue;
      }
      const { outlineStyle, outlineColor } = getComputedStyle(ring);
      if (outlineStyle === "auto") continue; // the browser's own, in two colours
      const value = contrast(outlineColor, ring.parentElement ?? ring);
      if (value < LEAST_CONTRAST) found.add(`${nameOf(element)}: ring ${value.toFixed(1)}:1`);
    }
    document.activeElement.blur();
  }

  checkTexts();
  checkFields();
  checkRings();
  return [...found];
})()
