/// A page of a few words in place of the built one.

#include "app/scope/scope_page.hpp"

namespace graben::scope {

std::string_view scope_page_head() { return "<!doctype html><title>Graben</title><script>"; }
std::string_view scope_page_tail() { return "</script>\n"; }

}  // namespace graben::scope
