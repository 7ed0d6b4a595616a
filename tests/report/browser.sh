#!/bin/sh
# browser.sh PAGE WORK: looks at an HTML page in headless Chromium, 1280 and 400 pixels wide. Fails if the page is wider
# than its frame, if a picture is missing, empty or too small to be read, or if it asks for anything from outside.
# Exits with 77 (skipped) if there is no Chromium.
set -eu
page=$1
work=$2
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
if [ -z "$browser" ]; then
    echo "SKIPPED: no Chromium is installed, so nobody looked at $page. Install it (Debian: apt-get install chromium)."
    exit 77
fi
[ -f "$page" ] || {
    echo "There is no page $page."
    exit 1
}
rm -rf "$work"
mkdir -p "$work"

# Frames of both widths around the page; what is wrong is written into the document, which Chromium then prints.
{
    printf '<!DOCTYPE html><meta charset="utf-8"><body>\n'
    for width in 1280 400; do
        printf '<iframe width="%s" height="900" style="border:0" srcdoc="' "$width"
        sed -e 's/&/\&amp;/g' -e 's/"/\&quot;/g' "$page"
        printf '"></iframe>\n'
    done
    cat << 'SCRIPT'
<pre id="found"></pre>
<script>
window.addEventListener("load", () => {
    const found = [];
    for (const frame of document.querySelectorAll("iframe")) {
        const width = Number(frame.width), page = frame.contentDocument;
        const say = what => found.push("FAULT at " + width + " pixels: " + what);
        if (page.documentElement.scrollWidth > width)
            say("the page is " + page.documentElement.scrollWidth + " wide");
        for (const one of page.querySelectorAll("body *")) {
            if (one.closest(".frame") && !one.matches(".frame")) continue;
            if (one.closest("svg") && !one.matches("svg")) continue;
            const box = one.getBoundingClientRect();
            if (box.right > width + 1 || box.left < -1) say("an element sticks out: " + one.outerHTML.slice(0, 80));
        }
        const pictures = [...page.querySelectorAll("figure")];
        if (pictures.length == 0) say("there is no picture");
        for (const figure of pictures) {
            const svg = figure.querySelector("svg");
            if (!svg) { say("a figure has no picture"); continue; }
            const box = svg.getBoundingClientRect(), view = svg.viewBox.baseVal;
            if (box.width < 200 || box.height < 150) say("a picture is " + box.width + " by " + box.height);
            if (svg.querySelectorAll("path, use, polygon, circle, rect").length < 10) say("a picture is empty");
            for (const text of svg.querySelectorAll("text")) {
                const size = parseFloat(getComputedStyle(text).fontSize) * box.width / view.width;
                if (text.textContent.trim() && size < 7.9) say("text of " + size.toFixed(1) + " pixels: " + text.textContent);
                const there = text.getBoundingClientRect();
                if (there.right > box.right + 2 || there.left < box.left - 2 || there.bottom > box.bottom + 2)
                    say("text is cut: " + text.textContent.trim());
            }
        }
        for (const use of page.querySelectorAll("use")) {
            const name = use.getAttribute("xlink:href") || use.getAttribute("href");
            if (!name || !name.startsWith("#") || !page.getElementById(name.slice(1))) say("a mark is missing: " + name);
        }
        for (const image of page.querySelectorAll("img"))
            if (!image.complete || image.naturalWidth == 0) say("an image is missing: " + image.src.slice(0, 80));
        for (const one of page.querySelectorAll("[src], link[href]")) {
            const name = one.getAttribute("src") || one.getAttribute("href");
            if (!name.startsWith("data:")) say("the page needs another file: " + name.slice(0, 80));
        }
        const names = [...page.querySelectorAll("[id]")].map(one => one.id);
        if (new Set(names).size != names.length) say("two elements have one id");
        found.push("LOOKED at " + width + " pixels: " + pictures.length + " pictures, " +
                   page.querySelectorAll("table").length + " tables, " + page.documentElement.scrollHeight + " high");
    }
    document.querySelectorAll("iframe").forEach(frame => frame.remove());
    document.getElementById("found").textContent = found.join("\n");
});
</script>
SCRIPT
} > "$work/frames.html"

timeout 240 "$browser" --headless --no-sandbox --disable-gpu --disable-background-networking --no-first-run \
    --user-data-dir="$work/profile" --window-size=1700,1000 --virtual-time-budget=20000 --dump-dom \
    "file://$work/frames.html" > "$work/dom.html" 2> "$work/browser.log" || {
    echo "Chromium failed:"
    cat "$work/browser.log"
    exit 1
}
rm -rf "$work/profile"
sed -n '/<pre id="found">/,/<\/pre>/p' "$work/dom.html" | sed 's/<[^>]*>//g'
if [ "$(grep -c 'LOOKED at' "$work/dom.html")" -lt 2 ] || grep -q '^\(<pre id="found">\)\{0,1\}FAULT' "$work/dom.html"; then
    echo "$page is not as it should be."
    exit 1
fi
