(function (canvas, scene) {
  "use strict";
  var pen = canvas.getContext("2d");
  if (!pen) { return; }
  var colours = ["#0b62a4", "#8a4fbf", "#1a8f3c", "#777777", "#b35c00"];
  var turn = -0.6, tilt = 0.6, zoom = 1, held = null;
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
      pen.beginPath(); pen.strokeStyle = colours[k % colours.length]; pen.lineWidth = strand.thin ? 0.6 : 1.6;
      var open = false;
      strand.points.forEach(function (p) {
        if (!p) { open = false; return; }
        var x = p[0] - middle[0], y = p[1] - middle[1], z = p[2] - middle[2];
        var u = wide / 2 + scale * (ct * x - st * y);
        var v = tall / 2 - scale * (cl * z + sl * (st * x + ct * y));
        if (open) { pen.lineTo(u, v); } else { pen.moveTo(u, v); open = true; }
      });
      pen.stroke();
      pen.fillStyle = colours[k % colours.length]; pen.font = "13px sans-serif";
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
    if (e.key === "+" || e.key === "-") { zoom *= e.key === "+" ? 1.2 : 1 / 1.2; draw(); }
  });
  window.addEventListener("resize", draw);
  draw();
})
