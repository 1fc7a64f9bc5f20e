# One switch for every target: a sanitizer only helps when the whole program carries it.
if(DUSKLINE_SANITIZE)
  add_compile_options(-fsanitize=${DUSKLINE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${DUSKLINE_SANITIZE})
endif()
