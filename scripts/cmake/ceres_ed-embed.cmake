# Puts files into a library, so that no file is looked up when a program runs.

# ceres_ed_embed(TARGET HEADER [FUNCTION FILES ...]): defines the functions of ceres_ed/report/HEADER, each of which
# returns the bytes of a file, or of several files, joined by |, one after the other, as a std::string_view.
function(ceres_ed_embed target header)
  get_filename_component(name ${header} NAME_WE)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cc)
  set(code "#include <ceres_ed/report/${header}>\n\n")
  string(APPEND code "// .incbin is known to GCC and clang.\n")
  set(functions "namespace ceres_ed {\n\n")
  set(files "")
  list(LENGTH ARGN count)
  math(EXPR last "${count} - 1")
  foreach(i RANGE 0 ${last} 2)
    math(EXPR j "${i} + 1")
    list(GET ARGN ${i} function)
    list(GET ARGN ${j} parts)
    string(REPLACE "|" ";" parts "${parts}")
    set(includes "")
    foreach(file IN LISTS parts)
      list(APPEND files ${file})
      # The hash of the file stands in the code, so that a compiler cache sees that a file has changed.
      file(SHA256 ${file} hash)
      string(APPEND code "// ${hash}\n")
      string(APPEND includes "    \".incbin \\\"${file}\\\"\\n\"\n")
    endforeach()
    set(symbol ceres_ed_file_${function})
    string(APPEND code "__asm__(\n    \".section .rodata\\n\"\n"
           "    \".global ${symbol}, ${symbol}_end\\n\"\n"
           "    \".hidden ${symbol}, ${symbol}_end\\n\"\n"
           "    \"${symbol}:\\n\"\n${includes}    \"${symbol}_end:\\n.byte 0\\n.previous\\n\");\n"
           "extern \"C\" const char ${symbol}[], ${symbol}_end[];\n\n")
    string(APPEND functions "std::string_view ${function}() {\n"
           "  return {${symbol}, static_cast<std::size_t>(${symbol}_end - ${symbol})};\n}\n\n")
  endforeach()
  file(CONFIGURE OUTPUT ${source} CONTENT "${code}${functions}}  // namespace ceres_ed\n" @ONLY)
  set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES OBJECT_DEPENDS "${files}")
  # A changed file is configured again, for its hash.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  target_sources(${target} PRIVATE ${source})
endfunction()
