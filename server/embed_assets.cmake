# Turns a directory of built web files into one assembler file and one C++ table.
# The assembler's .incbin takes megabytes in no time, which a C++ array does not.
# Usage: cmake -DDIST=... -DOUT=... -P embed_assets.cmake
file(MAKE_DIRECTORY ${OUT})
if(EXISTS ${DIST}/index.html)
  file(GLOB_RECURSE FILES RELATIVE ${DIST} ${DIST}/*)
  set(ROOT ${DIST})
else()
  # Shown when the web client was not built; not a user interface.
  set(ROOT ${OUT}/missing)
  file(WRITE ${ROOT}/index.html "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Pulseline</title>
<h1>The web client is not part of this build</h1>
<p>Build it with <code>npm ci &amp;&amp; npm run build</code> in the folder <code>web</code>, then build
the server again. The API answers under <code>/api/v1</code>.</p></html>
")
  set(FILES index.html)
endif()

set(TYPE_html "text/html\\; charset=utf-8")
set(TYPE_js "text/javascript\\; charset=utf-8")
set(TYPE_css "text/css\\; charset=utf-8")
set(TYPE_json "application/json")
set(TYPE_map "application/json")
set(TYPE_svg "image/svg+xml")
set(TYPE_png "image/png")
set(TYPE_webp "image/webp")
set(TYPE_ico "image/x-icon")
set(TYPE_woff2 "font/woff2")
set(TYPE_wasm "application/wasm")
set(TYPE_webmanifest "application/manifest+json")
set(TYPE_txt "text/plain\\; charset=utf-8")

list(SORT FILES COMPARE STRING)
set(ASSEMBLER ".section .rodata\n")
set(EXTERNS "")
set(ROWS "")
set(NUMBER 0)
foreach(FILE IN LISTS FILES)
  set(RAW ${ROOT}/${FILE})
  set(PACKED ${OUT}/asset_${NUMBER}.gz)
  execute_process(COMMAND gzip -9nc ${RAW} OUTPUT_FILE ${PACKED} COMMAND_ERROR_IS_FATAL ANY)
  file(SIZE ${RAW} RAW_SIZE)
  file(SIZE ${PACKED} PACKED_SIZE)
  math(EXPR WORTH "${RAW_SIZE} * 9 / 10")
  if(PACKED_SIZE GREATER WORTH)
    file(WRITE ${PACKED} "")
    set(PACKED_SIZE 0)
  endif()
  foreach(KIND raw gz)
    set(BLOB ${RAW})
    if(KIND STREQUAL "gz")
      set(BLOB ${PACKED})
    endif()
    set(SYMBOL pulseline_asset_${NUMBER}_${KIND})
    string(APPEND ASSEMBLER ".global ${SYMBOL}\n.balign 16\n${SYMBOL}:\n.incbin \"${BLOB}\"\n.byte 0\n")
    string(APPEND EXTERNS "extern \"C\" const char ${SYMBOL}[];\n")
  endforeach()
  file(SHA256 ${RAW} HASH)
  string(SUBSTRING ${HASH} 0 32 HASH)
  string(REGEX MATCH "[^.]*$" EXTENSION ${FILE})
  set(TYPE "application/octet-stream")
  if(DEFINED TYPE_${EXTENSION})
    set(TYPE "${TYPE_${EXTENSION}}")
  endif()
  set(IMMUTABLE false)
  if(FILE MATCHES "^assets/.*-[A-Za-z0-9_-][A-Za-z0-9_-][A-Za-z0-9_-][A-Za-z0-9_-][A-Za-z0-9_-][A-Za-z0-9_-][A-Za-z0-9_-][A-Za-z0-9_-]+[.][a-z0-9]+$")
    set(IMMUTABLE true)
  endif()
  string(APPEND ROWS "    {\"/${FILE}\", \"${TYPE}\", \"\\\"${HASH}\\\"\", ${IMMUTABLE},\n"
    "     {pulseline_asset_${NUMBER}_raw, ${RAW_SIZE}}, {pulseline_asset_${NUMBER}_gz, ${PACKED_SIZE}}},\n")
  math(EXPR NUMBER "${NUMBER} + 1")
endforeach()
string(REPLACE "\\;" ";" ROWS "${ROWS}")
file(WRITE ${OUT}/assets_data.S "${ASSEMBLER}.section .note.GNU-stack,\"\",%progbits\n")
file(WRITE ${OUT}/assets_table.cpp "#include \"server/sessions/assets.hpp\"\n\n${EXTERNS}
namespace pulseline::server {
namespace {
const Asset kAssets[] = {
${ROWS}};
}  // namespace
std::span<const Asset> assets() { return kAssets; }
}  // namespace pulseline::server
")
