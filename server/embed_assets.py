#!/usr/bin/env python3
"""Turns a directory of built web files into one assembler file and one C++ table.

The assembler's .incbin takes megabytes in no time, which a C++ array does not.
Usage: embed_assets.py DIST OUT_DIR
"""
import gzip
import hashlib
import pathlib
import re
import sys

TYPES = {
    ".html": "text/html; charset=utf-8", ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8", ".json": "application/json", ".svg": "image/svg+xml",
    ".png": "image/png", ".ico": "image/x-icon", ".woff2": "font/woff2",
    ".webmanifest": "application/manifest+json", ".txt": "text/plain; charset=utf-8",
    ".map": "application/json", ".webp": "image/webp", ".wasm": "application/wasm",
}
# Shown when the web client was not built; not a user interface.
MISSING = b"""<!doctype html><html lang="en"><meta charset="utf-8"><title>Pulseline</title>
<h1>The web client is not part of this build</h1>
<p>Build it with <code>npm ci &amp;&amp; npm run build</code> in the folder <code>web</code>, then build
the server again. The API answers under <code>/api/v1</code>.</p></html>
"""


def main() -> None:
    dist, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    if (dist / "index.html").is_file():
        files = {"/" + p.relative_to(dist).as_posix(): p.read_bytes()
                 for p in sorted(dist.rglob("*")) if p.is_file()}
    else:
        files = {"/index.html": MISSING}
    assembler = [".section .rodata\n"]
    externs, rows = [], []
    for number, (path, content) in enumerate(sorted(files.items())):
        packed = gzip.compress(content, 9, mtime=0)
        if len(packed) > 0.9 * len(content):
            packed = b""
        for kind, data in (("raw", content), ("gz", packed)):
            blob = out / f"asset_{number}.{kind}"
            blob.write_bytes(data)
            symbol = f"pulseline_asset_{number}_{kind}"
            assembler.append(f'.global {symbol}\n.balign 16\n{symbol}:\n.incbin "{blob}"\n.byte 0\n')
            externs.append(f'extern "C" const char {symbol}[];')
        etag = hashlib.sha256(content).hexdigest()[:32]
        hashed = re.search(r"-[A-Za-z0-9_-]{8,}\.[a-z0-9]+$", path) and path.startswith("/assets/")
        kind = TYPES.get(pathlib.PurePosixPath(path).suffix, "application/octet-stream")
        rows.append(f'    {{"{path}", "{kind}", "\\"{etag}\\"", {"true" if hashed else "false"}, '
                    f"{{pulseline_asset_{number}_raw, {len(content)}}}, "
                    f"{{pulseline_asset_{number}_gz, {len(packed)}}}}},")
    assembler.append('.section .note.GNU-stack,"",%progbits\n')
    table = ['#include "server/assets.hpp"', "", *externs, "", "namespace pulseline::server {",
             "namespace {", "const Asset kAssets[] = {", *rows, "};", "}  // namespace",
             "std::span<const Asset> assets() { return kAssets; }",
             "}  // namespace pulseline::server", ""]
    (out / "assets_data.S").write_text("".join(assembler))
    (out / "assets_table.cpp").write_text("\n".join(table))


main()
