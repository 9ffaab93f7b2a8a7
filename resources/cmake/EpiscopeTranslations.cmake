# Translations of the window, compiled into it where Qt's lrelease is installed; without it, the window
# is in English. How to add a language: resources/manual/pages/adding.md.
set(EPISCOPE_LANGUAGES de en)
set(EPISCOPE_TRANSLATIONS "${CMAKE_SOURCE_DIR}/resources/translations")
set(linguist_tools "${QT6_INSTALL_PREFIX}/${QT6_INSTALL_BINS}")
find_program(EPISCOPE_LRELEASE lrelease HINTS "${linguist_tools}")
find_program(EPISCOPE_LUPDATE lupdate HINTS "${linguist_tools}")

# episcope_add_translations(target): adds all languages as files :/episcope/translations/<code>.qm.
function(episcope_add_translations target)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/translations")
  set(files "")
  set(compiled)
  if(EPISCOPE_LRELEASE)
    foreach(language ${EPISCOPE_LANGUAGES})
      set(sources "${EPISCOPE_TRANSLATIONS}/episcope_${language}.ts")
      if(EXISTS "${EPISCOPE_TRANSLATIONS}/qt_${language}.ts")
        list(APPEND sources "${EPISCOPE_TRANSLATIONS}/qt_${language}.ts")
      endif()
      add_custom_command(OUTPUT "${folder}/${language}.qm"
                         COMMAND "${EPISCOPE_LRELEASE}" -silent ${sources} -qm "${folder}/${language}.qm"
                         DEPENDS ${sources} VERBATIM)
      list(APPEND compiled "${folder}/${language}.qm")
      string(APPEND files "    <file>${language}.qm</file>\n")
    endforeach()
  else()
    message(STATUS "No lrelease (Debian: qt6-l10n-tools): the window will be in English only")
  endif()
  file(GENERATE OUTPUT "${folder}/translations.qrc" CONTENT
       "<RCC>\n  <qresource prefix=\"/episcope/translations\">\n${files}  </qresource>\n</RCC>\n")
  add_custom_command(OUTPUT "${folder}/translations.cpp"
                     COMMAND Qt6::rcc --name translations -o "${folder}/translations.cpp"
                             "${folder}/translations.qrc"
                     DEPENDS ${compiled} "${folder}/translations.qrc" VERBATIM)
  target_sources(${target} PRIVATE "${folder}/translations.cpp")
endfunction()

# Brings all texts of sources and engine into the files of translators.
if(EPISCOPE_LUPDATE)
  add_custom_target(update_translations
    COMMAND sh "${EPISCOPE_TRANSLATIONS}/update.sh" $<TARGET_FILE:episcope_texts> "${EPISCOPE_LUPDATE}"
            "${CMAKE_SOURCE_DIR}" "${EPISCOPE_TRANSLATIONS}" -no-obsolete
    DEPENDS episcope_texts VERBATIM USES_TERMINAL)
endif()
