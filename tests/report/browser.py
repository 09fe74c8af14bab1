"""Looks at reports in headless Chromium; run by hand, as it needs a browser.

    python3 -m venv /tmp/venv && /tmp/venv/bin/pip install playwright        (the browser: apt-get install chromium)
    /tmp/venv/bin/python tests/report/browser.py out/single_asperity/report.html out/study/report.html --pictures /tmp/pictures

Checks, light and dark, wide and narrow: no message on the console, no request but that of the page itself, every figure drawn and
visible, no sideways scrolling of the page, readable contrast of text, and the player of the animation: it moves, pauses, scrubs, keeps
still for those who prefer that, and plays without scripts. With --pictures it leaves screenshots for those who have eyes.
"""

import argparse
import pathlib
import sys

from playwright.sync_api import sync_playwright

FIGURES = """() => [...document.querySelectorAll('figure svg')].map(svg => {
    const box = svg.getBoundingClientRect();
    return { label: svg.getAttribute('aria-label'), wide: box.width, high: box.height, marks: svg.querySelectorAll('path, text').length };
})"""
# Luminance contrast of all text against the ground of the page or the nearest ground above it (WCAG 2).
CONTRAST = """() => {
    const parse = c => c.match(/[\\d.]+/g).map(Number);
    const light = ([r, g, b]) => [r, g, b].map(v => v / 255).map(v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
        .reduce((sum, v, k) => sum + v * [0.2126, 0.7152, 0.0722][k], 0);
    const ground = e => { for (; e; e = e.parentElement) { const c = parse(getComputedStyle(e).backgroundColor); if (c[3] !== 0) return c; } return [255, 255, 255]; };
    const texts = [...document.querySelectorAll('main *')].filter(e => !e.closest('svg') && [...e.childNodes].some(n => n.nodeType === 3 && n.data.trim()));
    return Math.min(...texts.map(e => {
        const [a, b] = [light(parse(getComputedStyle(e).color)), light(ground(e))];
        return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    }));
}"""
SHOWN = "() => [...document.querySelectorAll('.asperity-frame')].map((f, k) => getComputedStyle(f).visibility === 'visible' ? k : -1).filter(k => k >= 0)"


def look(browser, page_file, scheme, width, pictures):
    """What is wrong with a page in one kind of window."""
    wrong, requests = [], []
    page = browser.new_page(viewport={"width": width, "height": 900}, color_scheme=scheme)
    page.on("console", lambda message: wrong.append(f"console: {message.text}"))
    page.on("pageerror", lambda error: wrong.append(f"error: {error}"))
    page.on("request", lambda request: requests.append(request.url))
    page.goto(page_file.resolve().as_uri())
    page.wait_for_timeout(300)
    wrong += [f"request: {url[:80]}" for url in requests if not url.startswith(("file:", "data:"))] + (["more than one file"] if sum(u.startswith("file:") for u in requests) > 1 else [])
    figures = page.evaluate(FIGURES)
    wrong += [] if figures else ["no figures"]
    for figure in figures:
        if figure["wide"] < min(250, width - 60) or figure["high"] < 60 or figure["marks"] < 10 or not figure["label"]:
            wrong.append(f"figure: {figure}")
    across = page.evaluate("() => document.documentElement.scrollWidth - document.documentElement.clientWidth")
    wrong += [f"the page is {across} px too wide"] if across > 0 else []
    contrast = page.evaluate(CONTRAST)
    wrong += [f"contrast {contrast:.2f}"] if contrast < 4.5 else []
    if pictures:
        page.screenshot(path=pictures / f"{page_file.parent.name}-{scheme}-{width}.png", full_page=True)
    page.close()
    return sorted(set(wrong)), len(figures), contrast


def player(browser, page_file):
    """What is wrong with the animation."""
    wrong = []
    page = browser.new_page()
    page.goto(page_file.resolve().as_uri())
    if page.evaluate("() => document.querySelectorAll('.asperity-frame').length") == 0:
        return ["no animation"]
    before = page.evaluate(SHOWN)
    page.wait_for_timeout(700)
    after = page.evaluate(SHOWN)
    wrong += [f"one picture at a time: {before} {after}"] if len(before) != 1 or len(after) != 1 else []
    wrong += ["it does not move"] if before == after else []
    page.get_by_role("button", name="Pause").click()
    before = page.evaluate(SHOWN)
    page.wait_for_timeout(500)
    wrong += ["it does not pause"] if page.evaluate(SHOWN) != before else []
    page.locator(".player input").fill("1")
    wrong += [f"it does not scrub: {page.evaluate(SHOWN)}"] if page.evaluate(SHOWN) != [1] else []
    page.get_by_role("button", name="Play").click()
    page.wait_for_timeout(200)
    wrong += ["it does not play again"] if page.evaluate(SHOWN) == [1] else []
    page.close()
    page = browser.new_page(reduced_motion="reduce")
    page.goto(page_file.resolve().as_uri())
    before = page.evaluate(SHOWN)
    page.wait_for_timeout(500)
    wrong += ["it moves although less motion is preferred"] if page.evaluate(SHOWN) != before or len(before) != 1 else []
    page.close()
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(page_file.resolve().as_uri())
    before = page.locator("figure svg").first.screenshot()
    page.wait_for_timeout(500)
    wrong += ["it does not play without scripts"] if page.locator("figure svg").first.screenshot() == before else []
    context.close()
    return wrong


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("reports", nargs="+", type=pathlib.Path)
    arguments.add_argument("--pictures", type=pathlib.Path)
    arguments.add_argument("--browser", default="/usr/bin/chromium")
    options = arguments.parse_args()
    if options.pictures:
        options.pictures.mkdir(parents=True, exist_ok=True)
    failed = False
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=options.browser, args=["--no-sandbox"])
        print(f"Chromium {browser.version}")
        for report in options.reports:
            for scheme in ("light", "dark"):
                for width in (1200, 360):
                    wrong, count, contrast = look(browser, report, scheme, width, options.pictures)
                    failed |= bool(wrong)
                    print(f"{report}: {scheme}, {width} px: {count} figures, least contrast {contrast:.1f}: {wrong or 'good'}")
            wrong = player(browser, report)
            if wrong != ["no animation"]:
                failed |= bool(wrong)
            print(f"{report}: animation: {wrong or 'good'}")
        browser.close()
    sys.exit(failed)


if __name__ == "__main__":
    main()
