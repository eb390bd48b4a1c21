# run(OUTPUT COMMAND ...): the command's stdout in the variable OUTPUT; ends the script where it fails.
function(run output)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE error
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}: ${result}\n${out}\n${error}")
  endif()
  set(${output} "${out}" PARENT_SCOPE)
endfunction()

# expect_no_paths(FILE WORD ...): no word is in the file.
function(expect_no_paths file)
  file(READ ${file} text)
  foreach(word IN LISTS ARGN)
    string(FIND "${text}" "${word}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} names ${word}")
    endif()
  endforeach()
endfunction()
