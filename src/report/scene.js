(function (canvas, scene) {
  "use strict";
  var pen = canvas.getContext("2d");
  if (!pen) { return; }
  var colours = ["#0b62a4", "#8a4fbf", "#1a8f3c", "#777777", "#b35c00"];
  var turn = -0.6, tilt = 0.6, zoom = 1, held = null, phase = 0;
  var moving = scene.some(function (strand) { return strand.swing; });
  var robot = moving || scene.some(function (strand) { return strand.disc; });
  var still = window.matchMedia && window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  var low = [1e300, 1e300, 1e300], high = [-1e300, -1e300, -1e300];
  scene.forEach(function (strand) {
    strand.points.forEach(function (p) {
      if (p) { for (var i = 0; i < 3; i++) { low[i] = Math.min(low[i], p[i]); high[i] = Math.max(high[i], p[i]); } }
    });
  });
  var middle = [0, 1, 2].map(function (i) { return 0.5 * (low[i] + high[i]); });
  var size = Math.max(1e-9, Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]));
  function draw() {
    var ratio = window.devicePixelRatio || 1, wide = canvas.clientWidth, tall = canvas.clientHeight;
    canvas.width = wide * ratio; canvas.height = tall * ratio;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, wide, tall);
    var scale = zoom * Math.min(wide, tall) / size;
    var ct = Math.cos(turn), st = Math.sin(turn), cl = Math.cos(tilt), sl = Math.sin(tilt);
    scene.forEach(function (strand, k) {
      var colour = colours[k % colours.length];
      if (strand.tint !== undefined) { colour = "hsl(" + Math.round(220 - 220 * strand.tint) + ",75%,40%)"; }
      pen.beginPath(); pen.strokeStyle = colour; pen.lineWidth = strand.thin ? 0.6 : robot && strand.points.length < 20 ? 4 : 1.6;
      pen.fillStyle = colour; pen.font = "13px sans-serif";
      var open = false;
      strand.points.forEach(function (p, i) {
        if (!p) { open = false; return; }
        var by = strand.swing ? Math.sin(phase) : 0, w = strand.swing ? strand.swing[i] : p;
        var early = strand.lead ? Math.cos(phase) : 0, l = strand.lead ? strand.lead[i] : p;
        var x = p[0] + by * w[0] + early * l[0] - middle[0];
        var y = p[1] + by * w[1] + early * l[1] - middle[1];
        var z = p[2] + by * w[2] + early * l[2] - middle[2];
        var u = wide / 2 + scale * (ct * x - st * y);
        var v = tall / 2 - scale * (cl * z + sl * (st * x + ct * y));
        if (strand.disc) {
          pen.moveTo(u + 6, v); pen.arc(u, v, 6, 0, 6.2832); pen.fill(); pen.fillText(strand.name, u + 10, v - 6);
        } else if (open) { pen.lineTo(u, v); } else { pen.moveTo(u, v); open = true; }
      });
      if (strand.disc) { return; }
      pen.stroke();
      pen.fillText(strand.name, 10, 18 + 16 * k);
    });
  }
  function by(dt, dl) { turn += dt; tilt = Math.max(-1.57, Math.min(1.57, tilt + dl)); draw(); }
  canvas.addEventListener("pointerdown", function (e) { held = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener("pointermove", function (e) {
    if (held) { by((e.clientX - held[0]) * 0.01, (e.clientY - held[1]) * 0.01); held = [e.clientX, e.clientY]; }
  });
  canvas.addEventListener("pointerup", function () { held = null; });
  canvas.addEventListener("wheel", function (e) { e.preventDefault(); zoom *= Math.exp(-0.001 * e.deltaY); draw(); }, { passive: false });
  canvas.addEventListener("keydown", function (e) {
    var steps = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
    if (steps[e.key]) { e.preventDefault(); by(steps[e.key][0], steps[e.key][1]); }
    if (e.key === " " && moving) { e.preventDefault(); still = !still; }
    if (e.key === "+" || e.key === "-") { zoom *= e.key === "+" ? 1.2 : 1 / 1.2; draw(); }
  });
  window.addEventListener("resize", draw);
  draw();
  function step() {
    if (!still) { phase += 0.06; draw(); }
    window.requestAnimationFrame(step);
  }
  if (moving) { window.requestAnimationFrame(step); }
})
