# Shared with users: the build uses this file, and so does the installed package.

# ceres_ed_add_plugin(NAME SOURCE ...): builds NAME.so, which programs load by --plugin=NAME.so. One of the
# sources has CERES_ED_PLUGIN(...) (ceres_ed/plugin/plugin_abi.h).
#
# A plugin links the library as it is here. Of a shared one it uses the copy that the program has loaded.
# Of a static one it gets those parts that it calls, as copies of its own, which nobody else sees:
# --exclude-libs and hidden visibility keep the dynamic linker from mixing them with the program's.
# Objects pass between program and plugin by virtual functions, which are indifferent to that; so a
# plugin of either kind works in programs of either kind. Unused libraries are not loaded (--as-needed).
function(ceres_ed_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE ceres_ed::ceres_ed)
  set_target_properties(
    ${name}
    PROPERTIES PREFIX ""
               CXX_VISIBILITY_PRESET hidden
               VISIBILITY_INLINES_HIDDEN ON)
  target_link_options(${name} PRIVATE LINKER:--as-needed LINKER:--exclude-libs,ALL)
endfunction()
