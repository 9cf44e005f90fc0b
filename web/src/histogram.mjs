// SPDX-License-Identifier: Apache-2.0
/** Tets by L/r, on a scale of square roots so that the few bad ones are seen: bars now, a line before the first cut. */
export function drawHistogram(canvas, before, now, bar, line) {
  const pen = canvas.getContext('2d'), { width, height } = canvas;
  const most = Math.sqrt(Math.max(1, ...before, ...now)), foot = height - 26;
  const x = (i) => (i * width) / now.length, y = (count) => foot - (Math.sqrt(count) / most) * (foot - 6);
  pen.clearRect(0, 0, width, height);
  pen.fillStyle = bar;
  now.forEach((count, i) => pen.fillRect(x(i) + 1, y(count), width / now.length - 2, foot - y(count)));
  pen.strokeStyle = pen.fillStyle = line;
  pen.lineWidth = 2;
  pen.beginPath();
  before.forEach((count, i) => {
    pen.lineTo(x(i), y(count));
    pen.lineTo(x(i + 1), y(count));
  });
  pen.stroke();
  pen.font = '20px sans-serif';
  pen.textAlign = 'left';
  pen.fillText('4.9', 0, height - 4);
  pen.textAlign = 'center';
  pen.fillText('31', width / 2, height - 4);
  pen.textAlign = 'right';
  pen.fillText('200', width, height - 4);
}
