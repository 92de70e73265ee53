#!/bin/bash
# SPDX-License-Identifier: MIT
# The report of a run does in a browser what it promises. Usage: report_in_browser_test.sh PROGRAM FOLDER CHROMIUM
# FOLDER keeps playwright-core, an npm package that drives the browser.
source "$(dirname "$0")/cli_helpers.sh"
package=playwright-core@1.64.1
[ -d "$2/node_modules/playwright-core" ] || npm install --no-audit --no-fund --prefix "$2" "$package" >&2 ||
  { echo "FAILED: $package cannot be installed"; exit 1; }
cd "$folder" || exit 2

# A ball of two charts, cut along the plane z = 0 by materials, and a far smaller one beside it.
python3 - <<'MESH'
import math
n = 24
with open("balls.obj", "w") as f:
    first = 1
    for radius, x in ((1, 0), (.2, 1.5)):
        for i in range(n + 1):
            for j in range(2 * n):
                a, b = math.pi * i / n, math.pi * j / n
                f.write("v %.9g %.9g %.9g\n" % (x + radius * math.sin(a) * math.cos(b), radius * math.sin(a) * math.sin(b), radius * math.cos(a)))
        for i in range(n):
            f.write("usemtl %s\n" % ("north" if i < n // 2 else "south"))
            for j in range(2 * n):
                p, q = first + 2 * n * i + j, first + 2 * n * i + (j + 1) % (2 * n)
                f.write("f %d %d %d %d\n" % (p, p + 2 * n, q + 2 * n, q))
        first += 2 * n * (n + 1)
MESH
run 0 balls.obj -o balls.obj_atlas.obj --separate-materials --texture-size 512 --threads 1 --pictures --quiet

# browse FILE: looks at a report; every sentence that does not hold is printed and counted.
browse() {
  NODE_PATH=$2/node_modules node - "$1" "$3" <<'JS'
const { chromium } = require("playwright-core");
const [file, executablePath] = process.argv.slice(2);
let faults = 0;
const check = (holds, sentence) => { if (!holds) { console.log("does not hold: " + sentence); ++faults; } };
(async () => {
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--use-gl=angle",
    "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
  const page = await browser.newPage({ viewport: { width: 1280, height: 1000 } });
  const errors = [], requests = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("request", (request) => requests.push(request.url()));
  await page.goto("file://" + file);
  await page.waitForSelector("#modes button", { timeout: 20000 });
  const settle = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await page.evaluate(() => Promise.all([...document.images].map((image) => image.decode())));
  await settle();

  // Pixels of the model, and of what lies over the page, in shares of their sides.
  const onModel = (x, y) => page.evaluate(([x, y]) => {
    const c = document.getElementById("view"), gl = c.getContext("webgl2"), p = new Uint8Array(4);
    gl.readPixels(Math.floor(x * c.width), Math.floor(y * c.height), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, p);
    return [...p];
  }, [x, y]);
  const marked = () => page.evaluate(() => {
    const c = document.getElementById("overlay"), p = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
    const b = [c.width, c.height, 0, 0];
    let n = 0;
    for (let i = 0; i < p.length; i += 4) if (p[i + 3]) {
      const x = (i / 4) % c.width, y = Math.floor(i / 4 / c.width);
      ++n; b[0] = Math.min(b[0], x); b[1] = Math.min(b[1], y); b[2] = Math.max(b[2], x); b[3] = Math.max(b[3], y);
    }
    return { n, b };
  });
  const chosen = () => page.textContent("#chosen");
  const middle = async (selector) => { const b = await page.locator(selector).boundingBox(); return [b.x + b.width / 2, b.y + b.height / 2, b]; };
  const leave = async () => { await page.mouse.move(2, 2); await settle(); };

  // The big ball is left of the middle of the view.
  const background = await onModel(0.01, 0.01), before = await onModel(0.35, 0.5);
  check(background.join() !== before.join(), "the model is drawn");
  check((await marked()).n === 0 && (await chosen()) === "", "nothing is chosen at first");

  const [x, y, view] = await middle("#view");
  await page.mouse.move(view.x + 0.35 * view.width, y); await settle();
  const onHover = await marked(), text = await chosen();
  check(/^chart \d+: \d+ triangles, mean distortion [\d.]+, stretch [\d.]+/.test(text), "a chart that one points at on the model is named");
  check(onHover.n > 1000, "it is marked on the page");
  check((await onModel(0.35, 0.5)).join() !== before.join(), "it is marked on the model");
  check(await page.evaluate((t) => { const row = document.querySelector("tr.chart.on"); return !row || t.startsWith("chart " + row.dataset.chart + ":"); }, text),
        "its row in the table is marked");
  await leave();
  check((await marked()).n === 0 && (await chosen()) === "", "nothing is chosen when one points elsewhere");

  // From the page to the model: the middle of what was marked.
  const overlay = await page.locator("#overlay").boundingBox();
  const find = await page.evaluate(([b]) => b, [onHover.b]);
  let named = "";
  for (let k = 1; k < 8 && named !== text; ++k) {
    await page.mouse.move(overlay.x + overlay.width * (find[0] + (find[2] - find[0]) * k / 8) / 1024, overlay.y + overlay.height * (find[1] + find[3]) / 2048);
    await settle();
    named = await chosen();
  }
  check(named === text, "a chart that one points at on the page is named, and is the one that was marked there");
  await leave();

  const plain = await page.evaluate(() => document.getElementById("view").toDataURL());
  for (const [name, ticks] of [["Charts", 0], ["Stretch", 3], ["Density", 3], ["Plain", 0], ["Checkerboard", 0]]) {
    await page.click(`#modes button:text-is("${name}")`); await settle();
    check((await page.locator("#legend.on .ticks span").count()) === ticks, name + " has its scale");
    check(await page.evaluate((n) => document.querySelector("#modes button.mode.on").textContent === n, name), name + " is the mode that is on");
    const stretch = await page.locator("#stretch").isVisible();
    check(stretch === (name === "Stretch") && (await page.locator("#page").isVisible()) === !stretch, name + " has its page");
    check(((await marked()).n > 0) === (name === "Density"), "density is painted over the page in its mode only: " + name);
    const now = await page.evaluate(() => document.getElementById("view").toDataURL());
    check((now === plain) === (name === "Checkerboard"), name + " has a look of its own");
  }
  await page.click("#seams"); await settle();
  check((await page.evaluate(() => document.getElementById("view").toDataURL())) !== plain, "seams can be left out");
  await page.click("#seams"); await settle();

  // The worst spot: one click.
  const rows = page.locator("tr.chart");
  check((await rows.count()) >= 4, "there is a row for each chart");
  await rows.first().click(); await settle();
  check((await page.locator(".ring.on").count()) === 2, "the worst spot has a ring on the model and on the page");
  check((await chosen()).startsWith("chart " + (await rows.first().getAttribute("data-chart")) + ":"), "its chart is chosen");
  const pixels = await onModel(0.5, 0.5);
  check(pixels.slice(0, 3).some((v) => v < 245), "the spot is in the middle of the view");
  await page.click("#whole"); await settle();
  check((await page.locator(".ring.on").count()) === 0, "the ring goes when the view changes");
  await leave();
  check((await page.evaluate(() => document.getElementById("view").toDataURL())) === plain, "the whole model is seen again");

  await page.mouse.move(x, y); await page.mouse.down(); await page.mouse.move(x + 100, y + 40, { steps: 3 }); await page.mouse.up(); await leave();
  check((await page.evaluate(() => document.getElementById("view").toDataURL())) !== plain, "the model turns");
  check(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "nothing is wider than the window");
  await page.setViewportSize({ width: 420, height: 800 }); await settle();
  check(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "nothing is wider than a telephone");
  check(errors.length === 0, "no script fails: " + errors.join("; "));
  check(requests.filter((url) => !/^(file|data):/.test(url)).length === 0 && requests.filter((url) => url.startsWith("file:")).length === 1, "nothing is loaded");
  await browser.close();
  process.exit(faults > 0 ? 1 : 0);
})().catch((error) => { console.log(error); process.exit(2); });
JS
}
browse "$folder/balls.obj_atlas.html" "$2" "$3" || fail "the report in a browser"

# A model that counts as large is turned as a rough copy on a slow computer, and is whole again afterwards: the same page with every frame late.
sed -e 's/many:900000/many:1/' -e 's/now-last>120/now-last>0/' balls.obj_atlas.html >slow.html
browse "$folder/slow.html" "$2" "$3" || fail "the report of a large model"

# The test sees a report of which charts are not linked.
sed 's/linked:true/linked:false/' balls.obj_atlas.html >broken.html
browse "$folder/broken.html" "$2" "$3" >faults.txt
grep -q 'is marked on the page' faults.txt || fail "a report without links is not noticed"
finish
