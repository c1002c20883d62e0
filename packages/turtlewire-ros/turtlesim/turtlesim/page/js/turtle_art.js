// A turtle from above, drawn with curves, looking along +x, about one metre long. Unit: metres.

/** Draw a turtle at the origin of `ctx`. `stride` in [-1, 1] is how far the flippers have swung. */
export function drawTurtle(ctx, look, stride) {
  ctx.lineJoin = "round";
  ctx.lineCap = "round";
  drawShadow(ctx);
  drawLimbs(ctx, look, stride);
  drawHead(ctx, look);
  SHELLS[look.shape](ctx, look);
}

function drawShadow(ctx) {
  const shade = ctx.createRadialGradient(-0.02, 0.03, 0.1, -0.02, 0.03, 0.5);
  shade.addColorStop(0, "rgb(8 12 50 / 45%)");
  shade.addColorStop(1, "rgb(8 12 50 / 0%)");
  ctx.fillStyle = shade;
  ctx.beginPath();
  ctx.ellipse(-0.02, 0.03, 0.5, 0.44, 0, 0, 2 * Math.PI);
  ctx.fill();
}

function drawLimbs(ctx, look, stride) {
  ctx.fillStyle = look.skin;
  ctx.strokeStyle = shaded(look.rim, 0.55);
  ctx.lineWidth = 0.014;
  for (const side of [-1, 1]) {
    limb(ctx, 0.16, side * 0.17, side * (1.02 - 0.34 * stride * side), 0.27, 0.075);
    limb(ctx, -0.2, side * 0.15, side * (2.35 + 0.3 * stride * side), 0.18, 0.06);
  }
  ctx.beginPath();
  ctx.moveTo(-0.28, -0.035);
  ctx.quadraticCurveTo(-0.38, -0.01, -0.42, 0.04 * stride);
  ctx.quadraticCurveTo(-0.38, 0.02, -0.28, 0.035);
  ctx.fill();
  ctx.stroke();
}

function limb(ctx, x, y, angle, length, width) {
  ctx.save();
  ctx.translate(x, y);
  ctx.rotate(angle);
  ctx.beginPath();
  ctx.moveTo(-0.02, -width * 0.8);
  ctx.bezierCurveTo(length * 0.5, -width * 1.5, length, -width * 0.9, length, 0);
  ctx.bezierCurveTo(length * 0.95, width * 0.8, length * 0.45, width * 1.1, -0.02, width * 0.8);
  ctx.fill();
  ctx.stroke();
  ctx.restore();
}

function drawHead(ctx, look) {
  ctx.fillStyle = look.skin;
  ctx.strokeStyle = shaded(look.rim, 0.55);
  ctx.lineWidth = 0.014;
  ctx.beginPath();
  ctx.moveTo(0.2, -0.085);
  ctx.bezierCurveTo(0.3, -0.1, 0.5, -0.17, 0.5, 0);
  ctx.bezierCurveTo(0.5, 0.17, 0.3, 0.1, 0.2, 0.085);
  ctx.fill();
  ctx.stroke();
  for (const side of [-1, 1]) {
    disc(ctx, 0.415, side * 0.075, 0.036, "#fdfdf7");
    disc(ctx, 0.428, side * 0.078, 0.021, "#14203a");
    disc(ctx, 0.436, side * 0.071, 0.007, "#ffffff");
  }
}

const SHELLS = {
  round(ctx, look) {
    shell(ctx, look, () => ctx.ellipse(-0.02, 0, 0.305, 0.265, 0, 0, 2 * Math.PI));
    scute(ctx, look, hexagon(-0.02, 0, 0.105));
    for (let k = 0; k < 6; k += 1) {
      const angle = (k + 0.5) * (Math.PI / 3);
      scute(ctx, look, hexagon(-0.02 + 0.205 * Math.cos(angle), 0.178 * Math.sin(angle), 0.062));
    }
  },
  sea(ctx, look) {
    shell(ctx, look, () => {
      ctx.moveTo(0.27, 0);
      ctx.bezierCurveTo(0.27, -0.24, 0.02, -0.34, -0.16, -0.2);
      ctx.quadraticCurveTo(-0.3, -0.09, -0.38, 0);
      ctx.quadraticCurveTo(-0.3, 0.09, -0.16, 0.2);
      ctx.bezierCurveTo(0.02, 0.34, 0.27, 0.24, 0.27, 0);
    });
    for (const x of [0.13, -0.02, -0.165]) {
      const left = [[x - 0.055, 0.055], [x + 0.02, 0.062]];
      const right = [[x + 0.02, -0.062], [x - 0.055, -0.055]];
      scute(ctx, look, [[x + 0.065, 0], ...right, [x - 0.08, 0], ...left]);
    }
    for (const side of [-1, 1]) {
      const put = (points) => scute(ctx, look, points.map(([x, y]) => [x, side * y]));
      put([[0.2, 0.08], [0.13, 0.09], [0.09, 0.2], [0.17, 0.17]]);
      put([[0.1, 0.1], [-0.03, 0.1], [-0.06, 0.22], [0.05, 0.225]]);
      put([[-0.07, 0.095], [-0.19, 0.075], [-0.18, 0.15], [-0.1, 0.205]]);
    }
  },
  box(ctx, look) {
    shell(ctx, look, () => ctx.roundRect(-0.31, -0.25, 0.59, 0.5, 0.19));
    for (const x of [-0.21, -0.07, 0.07]) {
      scute(ctx, look, [[x, -0.07], [x + 0.115, -0.07], [x + 0.115, 0.07], [x, 0.07]]);
      for (const side of [-1, 1]) {
        const [inner, outer] = [side * 0.098, side * 0.19];
        scute(ctx, look, [[x, inner], [x + 0.115, inner], [x + 0.105, outer], [x + 0.01, outer]]);
      }
    }
  },
};

function shell(ctx, look, outline) {
  const glow = ctx.createRadialGradient(0.05, -0.08, 0.02, -0.02, 0, 0.36);
  glow.addColorStop(0, look.scute);
  glow.addColorStop(0.55, look.shell);
  glow.addColorStop(1, look.rim);
  ctx.beginPath();
  outline();
  ctx.closePath();
  ctx.fillStyle = glow;
  ctx.fill();
  ctx.strokeStyle = look.rim;
  ctx.lineWidth = 0.03;
  ctx.stroke();
}

function scute(ctx, look, points) {
  ctx.beginPath();
  for (const [x, y] of points) ctx.lineTo(x, y);
  ctx.closePath();
  ctx.fillStyle = shaded(look.scute, 0.5);
  ctx.fill();
  ctx.strokeStyle = shaded(look.rim, 0.5);
  ctx.lineWidth = 0.012;
  ctx.stroke();
}

function hexagon(x, y, radius) {
  return Array.from({ length: 6 }, (_, k) => {
    const angle = (k * Math.PI) / 3;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
}

function disc(ctx, x, y, radius, colour) {
  ctx.fillStyle = colour;
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
  ctx.fill();
}

function shaded(colour, alpha) {
  return colour + Math.round(255 * alpha).toString(16).padStart(2, "0");
}
