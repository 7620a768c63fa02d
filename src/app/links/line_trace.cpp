// SPDX-License-Identifier: Apache-2.0
#include "line_trace.hpp"

namespace dpslave::app {
namespace {

trace::Kind kind_of(drive::TracedFrame::What what)
{
    switch (what) {
        case drive::TracedFrame::What::sent: return trace::Kind::asked;
        case drive::TracedFrame::What::heard: return trace::Kind::answered;
        case drive::TracedFrame::What::silence: break;
    }
    return trace::Kind::no_answer;
}

} // namespace

void LineTrace::on_frame(const drive::TracedFrame& frame)
{
    ring_.put({.kind = kind_of(frame.what),
               .detail = static_cast<std::uint8_t>(frame.judgement),
               .rate = static_cast<std::uint8_t>(frame.protocol),
               .address = frame.drive,
               .at = frame.at,
               .begun = frame.begun},
              frame.octets);
}

} // namespace dpslave::app
