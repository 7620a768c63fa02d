// SPDX-License-Identifier: Apache-2.0
#include "dpslave/gsd/check.hpp"

#include "check_parts.hpp"

#include <algorithm>

namespace dpslave::gsd {

Findings check(const Document& document, Reading reading, std::string_view file_name)
{
    Remarks remarks = document.remarks;
    Judge judge{document, remarks};
    if (document.has_section) {
        check_keywords(judge);
        check_parameters(judge);
    }
    // Up to here each line was judged by itself; the rest judges how they fit together.
    for (Remark& remark : remarks) remark.unread = remark.unread || remark.weight == Weight::error;
    if (document.has_section) {
        check_device(judge);
        check_modules(judge);
        if (!file_name.empty()) check_file_name(judge, file_name);
    }
    std::stable_sort(remarks.begin(), remarks.end(),
                     [](const Remark& a, const Remark& b) { return a.line < b.line; });

    const bool strict = reading == Reading::strict;
    Findings findings;
    for (Remark& remark : remarks) {
        if (remark.weight == Weight::pedantic && !strict) continue;
        const bool error = strict || remark.weight == Weight::error;
        findings.push_back({remark.line, error ? Severity::error : Severity::warning, std::move(remark.what),
                            remark.unread});
    }
    return findings;
}

} // namespace dpslave::gsd
