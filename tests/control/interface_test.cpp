// SPDX-License-Identifier: Apache-2.0
#include "control/interface.hpp"
#include "fixtures.hpp"
#include "varlink_reader.hpp"

#include <gtest/gtest.h>

namespace dpslave::control {
namespace {

Interface read(const std::string& members)
{
    return *parse_interface("interface a.b\n" + members);
}

TEST(ControlInterface, TextInTheProgramIsTheFile)
{
    EXPECT_EQ(interface_text(), test::control_varlink_file());
}

TEST(ControlInterface, IsReadAsASecondHandReadsIt)
{
    const auto interface = parse_interface(interface_text());
    ASSERT_TRUE(interface) << interface.error();
    const auto& written = test::control_varlink();

    EXPECT_EQ(interface->name, written.name);
    EXPECT_EQ(interface->types.size(), written.types.size());
    EXPECT_EQ(interface->errors.size(), written.errors.size());
    ASSERT_EQ(interface->methods.size(), written.outputs.size());
    for (const auto& [name, method] : interface->methods) {
        ASSERT_EQ(method.in.size(), written.inputs.at(name).size()) << name;
        ASSERT_EQ(method.out.size(), written.outputs.at(name).size()) << name;
        for (std::size_t i = 0; i < method.out.size(); ++i)
            EXPECT_EQ(method.out[i].name, written.outputs.at(name)[i].first);
    }
}

TEST(ControlInterface, HasOnlyTypesThatItDescribes)
{
    const auto interface = parse_interface(interface_text());
    const auto& written = test::control_varlink();
    for (const auto* group : {&written.types, &written.inputs, &written.outputs, &written.errors})
        for (const auto& [name, fields] : *group)
            for (const auto& [field, type] : fields) {
                if (type.find('(') != std::string::npos) continue;
                const std::string bare = type.substr(type.find_first_not_of("?[]"));
                EXPECT_TRUE(std::set<std::string>({"int", "float", "bool", "string"}).count(bare) == 1 ||
                            interface->types.count(bare) == 1)
                    << name << '.' << field << ": " << type;
            }
}

TEST(ServiceInterface, IsThatOfVarlink)
{
    const auto interface = parse_interface(service_interface_text());

    ASSERT_TRUE(interface) << interface.error();
    EXPECT_EQ(interface->name, "org.varlink.service");
    EXPECT_EQ(interface->methods.count("GetInfo") + interface->methods.count("GetInterfaceDescription"), 2u);
    for (const char* error : {"InterfaceNotFound", "MethodNotFound", "MethodNotImplemented",
                              "InvalidParameter", "PermissionDenied", "ExpectedMore"})
        EXPECT_EQ(interface->errors.count(error), 1u) << error;
}

TEST(InterfaceParser, RecognisesEveryFormOfAType)
{
    const Interface i = read("type T (a: bool, b: ?int, c: []float, d: [string]string, e: object, f: (one, "
                             "two), g: [](x: int), h: T)\n");
    const Struct& t = i.types.at("T").fields;

    using Kind = Type::Kind;
    EXPECT_EQ(t[0].type.kind, Kind::boolean);
    EXPECT_EQ(t[1].type.kind, Kind::integer);
    EXPECT_TRUE(t[1].type.nullable);
    EXPECT_EQ(t[2].type.inner->kind, Kind::number);
    EXPECT_EQ(t[3].type.kind, Kind::map);
    EXPECT_EQ(t[4].type.kind, Kind::object);
    EXPECT_EQ(t[5].type.words, (std::vector<std::string>{"one", "two"}));
    EXPECT_EQ(t[6].type.inner->fields[0].name, "x");
    EXPECT_EQ(t[7].type.kind, Kind::named);
}

TEST(InterfaceParser, SaysTheLineOfWhatItCannotRead)
{
    EXPECT_EQ(parse_interface("interface a.b\n\nmethod M( -> ()").error().substr(0, 7), "line 3:");
    EXPECT_FALSE(parse_interface(""));
    EXPECT_FALSE(parse_interface("interface a.b\nmethod M()"));
    EXPECT_FALSE(parse_interface("interface a.b\nmethod M(a) -> ()"));
    EXPECT_FALSE(parse_interface("interface a.b\ntype T (a: int, b)"));
    EXPECT_FALSE(parse_interface("interface a.b\ntype T (a: int) type T (a: int)"));
    EXPECT_FALSE(parse_interface("interface a.b\nthing T (a: int)"));
    EXPECT_FALSE(parse_interface("interface a.b\ntype T (a: " + std::string(5000, '(')));
}

struct Judged {
    const char* name;
    const char* type;
    const char* value;
    const char* wrong; ///< nullptr = fits
};
class TypeCheck : public testing::TestWithParam<Judged> {};

TEST_P(TypeCheck, NamesTheFirstFieldThatDoesNotFit)
{
    const Interface i = read("type W (tag: int)\nerror E (f: " + std::string{GetParam().type} + ")");

    const auto wrong = mismatch(i, i.errors.at("E"), Json::parse(GetParam().value));

    EXPECT_EQ(wrong.value_or("fits"), GetParam().wrong == nullptr ? "fits" : GetParam().wrong);
}

INSTANTIATE_TEST_SUITE_P(
    All, TypeCheck,
    testing::Values(Judged{"Integer", "int", R"({"f":-5})", nullptr},
                    Judged{"GreatestInteger", "int", R"({"f":9223372036854775807})", nullptr},
                    Judged{"IntegerBeyond64Bit", "int", R"({"f":9223372036854775808})", "f"},
                    Judged{"RealForInteger", "int", R"({"f":5.0})", "f"},
                    Judged{"TextForInteger", "int", R"({"f":"5"})", "f"},
                    Judged{"NullForInteger", "int", R"({"f":null})", "f"},
                    Judged{"Missing", "int", "{}", "f"}, Judged{"Unknown", "int", R"({"f":5,"g":1})", "g"},
                    Judged{"NullableNull", "?int", R"({"f":null})", nullptr},
                    Judged{"NullableMissing", "?int", "{}", nullptr},
                    Judged{"NullableWrong", "?int", R"({"f":"x"})", "f"},
                    Judged{"IntegerForReal", "float", R"({"f":5})", nullptr},
                    Judged{"TextForReal", "float", R"({"f":"5"})", "f"},
                    Judged{"Boolean", "bool", R"({"f":true})", nullptr},
                    Judged{"NumberForBoolean", "bool", R"({"f":1})", "f"},
                    Judged{"Text", "string", R"({"f":""})", nullptr},
                    Judged{"Enumeration", "(one, two)", R"({"f":"two"})", nullptr},
                    Judged{"OtherWord", "(one, two)", R"({"f":"three"})", "f"},
                    Judged{"Array", "[]int", R"({"f":[1,2]})", nullptr},
                    Judged{"ArrayItem", "[]int", R"({"f":[1,"x"]})", "f[1]"},
                    Judged{"ObjectForArray", "[]int", R"({"f":{}})", "f"},
                    Judged{"NamedInArray", "[]W", R"({"f":[{"tag":1},{"tag":"x"}]})", "f[1].tag"},
                    Judged{"UnknownInNamed", "W", R"({"f":{"tag":1,"x":2}})", "f.x"},
                    Judged{"Map", "[string]int", R"({"f":{"a":1}})", nullptr},
                    Judged{"MapItem", "[string]int", R"({"f":{"a":true}})", "f[a]"},
                    Judged{"ArrayForStructure", "(a: int)", R"({"f":[]})", "f"},
                    Judged{"Object", "object", R"({"f":{"any":[1]}})", nullptr},
                    Judged{"TypeNotDescribed", "Nowhere", R"({"f":1})", "f"}),
    [](const auto& row) { return row.param.name; });

TEST(ReplyCheck, IsThereForTheTestsOfOtherRooms)
{
    Json reply = test::fixture("GetStatus");
    EXPECT_EQ(reply_mismatch("GetStatus", reply), std::nullopt);

    reply["stations"][1]["drive"]["link"] = 5;
    EXPECT_EQ(reply_mismatch("GetStatus", reply), "stations[1].drive.link");
    EXPECT_EQ(reply_mismatch("GetNothing", reply), "no method GetNothing");
}

} // namespace
} // namespace dpslave::control
