// SPDX-License-Identifier: Apache-2.0
#include "dpslave/control/protocol.hpp"

#include <gtest/gtest.h>

#include <string>

namespace dpslave::control {
namespace {

using namespace std::string_literals;

std::string nested(int arrays)
{
    const auto n = static_cast<std::size_t>(arrays);
    return R"({"method":"a.B","parameters":{"x":)" + std::string(n, '[') + std::string(n, ']') + "}}";
}

TEST(VarlinkCall, HasAnInterfaceAMethodAndParameters)
{
    const auto call = parse_call(R"({"method":"org.dpslaved.Control.ReadTag","parameters":{"tag":56}})");

    ASSERT_TRUE(call);
    EXPECT_EQ(call->interface, "org.dpslaved.Control");
    EXPECT_EQ(call->method, "ReadTag");
    EXPECT_EQ(call->parameters, Json::parse(R"({"tag":56})"));
    EXPECT_FALSE(call->more || call->oneway || call->upgrade);
}

TEST(VarlinkCall, MayLeaveItsParametersOutOrSayNull)
{
    EXPECT_EQ(parse_call(R"({"method":"a.B"})")->parameters, Json::object());
    EXPECT_EQ(parse_call(R"({"method":"a.B","parameters":null,"more":null})")->parameters, Json::object());
}

TEST(VarlinkCall, CarriesItsFlags)
{
    EXPECT_TRUE(parse_call(R"({"method":"a.B","more":true})")->more);
    EXPECT_TRUE(parse_call(R"({"method":"a.B","oneway":true})")->oneway);
    EXPECT_TRUE(parse_call(R"({"method":"a.B","upgrade":true})")->upgrade);
}

struct Malformed {
    const char* name;
    std::string message;
    Flaw flaw;
};
class MalformedCall : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedCall, IsNamed)
{
    const auto call = parse_call(GetParam().message);

    ASSERT_FALSE(call);
    EXPECT_EQ(text(call.error()), text(GetParam().flaw));
}

INSTANTIATE_TEST_SUITE_P(
    All, MalformedCall,
    testing::Values(
        Malformed{"Empty", "", Flaw::not_json}, Malformed{"Blank", "  ", Flaw::not_json},
        Malformed{"Cut", R"({"method":"a.B")", Flaw::not_json},
        Malformed{"TwoValues", R"({"method":"a.B"} {})", Flaw::not_json},
        Malformed{"InvalidUtf8", "{\"method\":\"a.B\",\"parameters\":{\"x\":\"\xC3\x28\"}}", Flaw::not_json},
        Malformed{"LoneSurrogate", R"({"method":"a.B","parameters":{"x":"\ud800"}})", Flaw::not_json},
        Malformed{"NulInside", "{\"method\":\"a\0.B\"}"s, Flaw::not_json},
        Malformed{"NumberBeyondADouble", R"({"method":"a.B","parameters":{"x":1e999}})", Flaw::not_json},
        Malformed{"NotANumber", R"({"method":"a.B","parameters":{"x":NaN}})", Flaw::not_json},
        Malformed{"Comment", R"({"method":"a.B"/**/})", Flaw::not_json},
        Malformed{"Array", R"(["a.B"])", Flaw::not_object}, Malformed{"Text", R"("a.B")", Flaw::not_object},
        Malformed{"Null", "null", Flaw::not_object},
        Malformed{"NoMethod", R"({"parameters":{}})", Flaw::no_method},
        Malformed{"MethodNumber", R"({"method":7})", Flaw::bad_method},
        Malformed{"MethodNull", R"({"method":null})", Flaw::bad_method},
        Malformed{"MethodWithoutInterface", R"({"method":"GetStatus"})", Flaw::bad_method},
        Malformed{"MethodEndsWithADot", R"({"method":"org.dpslaved."})", Flaw::bad_method},
        Malformed{"MethodOnlyWithADot", R"({"method":".GetStatus"})", Flaw::bad_method},
        Malformed{"ParametersArray", R"({"method":"a.B","parameters":[]})", Flaw::bad_members},
        Malformed{"ParametersText", R"({"method":"a.B","parameters":"x"})", Flaw::bad_members},
        Malformed{"MoreText", R"({"method":"a.B","more":"yes"})", Flaw::bad_members},
        Malformed{"OnewayNumber", R"({"method":"a.B","oneway":1})", Flaw::bad_members},
        Malformed{"UpgradeObject", R"({"method":"a.B","upgrade":{}})", Flaw::bad_members},
        Malformed{"OnewayAndMore", R"({"method":"a.B","oneway":true,"more":true})", Flaw::bad_flags},
        Malformed{"TooDeep", nested(kMaxDepth - 1), Flaw::too_deep},
        Malformed{"VeryDeep", nested(2'000), Flaw::too_deep},
        Malformed{"TooLong", std::string(kMaxCall + 1, ' '), Flaw::too_long}),
    [](const auto& row) { return row.param.name; });

TEST(VarlinkCall, MayNestSixteenLevels)
{
    EXPECT_TRUE(parse_call(nested(kMaxDepth - 2))); // the call and its parameters are two levels
}

TEST(VarlinkCall, BracketsInTextAreNoNesting)
{
    const std::string brackets(100, '[');

    EXPECT_TRUE(parse_call(R"({"method":"a.B","parameters":{"x":"\"\\)" + brackets + R"("}})"));
}

TEST(VarlinkCall, OfTheGreatestLengthIsTaken)
{
    std::string message = R"({"method":"a.B"})";
    message.resize(kMaxCall, ' ');

    EXPECT_TRUE(parse_call(message));
}

TEST(VarlinkReply, HasParametersAndSaysWhetherMoreFollow)
{
    const auto last = parse_reply(R"({"parameters":{"a":1}})");
    const auto another = parse_reply(R"({"parameters":{"a":1},"continues":true})");

    EXPECT_EQ(last->parameters, Json::parse(R"({"a":1})"));
    EXPECT_FALSE(last->continues);
    EXPECT_TRUE(last->error.empty());
    EXPECT_TRUE(another->continues);
}

TEST(VarlinkReply, MayBeAnErrorWithItsName)
{
    const auto reply = parse_reply(R"({"error":"org.dpslaved.Control.Busy","parameters":{}})");

    EXPECT_EQ(reply->error, "org.dpslaved.Control.Busy");
}

TEST(VarlinkReply, WithMembersOfAWrongTypeIsNone)
{
    for (const char* message :
         {R"({"error":7})", R"({"error":""})", R"({"parameters":[]})", R"({"continues":1})"})
        EXPECT_EQ(parse_reply(message).error(), Flaw::bad_members) << message;
}

TEST(VarlinkEncoder, EndsAMessageWithOneNul)
{
    EXPECT_EQ(encode_call("GetStatus", Json::object()),
              "{\"method\":\"org.dpslaved.Control.GetStatus\",\"parameters\":{}}\0"s);
    EXPECT_EQ(encode_call("org.varlink.service.GetInfo", Json::object(), true),
              "{\"method\":\"org.varlink.service.GetInfo\",\"more\":true,\"parameters\":{}}\0"s);
    EXPECT_EQ(encode_reply({Json::parse(R"({"a":1})")}), "{\"parameters\":{\"a\":1}}\0"s);
    EXPECT_EQ(encode_reply({}, true), "{\"continues\":true,\"parameters\":{}}\0"s);
    EXPECT_EQ(encode_error({"Busy"}), "{\"error\":\"org.dpslaved.Control.Busy\",\"parameters\":{}}\0"s);
}

TEST(VarlinkEncoder, NeverPutsANulOrInvalidUtf8IntoAMessage)
{
    const std::string text = encode_reply({Json::object({{"x", "a\0b\xFF"s}})});

    EXPECT_EQ(text, "{\"parameters\":{\"x\":\"a\\u0000b\xEF\xBF\xBD\"}}\0"s);
}

} // namespace
} // namespace dpslave::control
