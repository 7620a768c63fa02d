#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""run.py ROOT PROGRAMS [PAGE [PICTURES]]: Cockpit's page of dpslaved in Chromium, as an operator and as a user without rights

PROGRAMS  the folder with dpslaved, dpctl and dpsim
PAGE      the folder with configurator.html and its manifest.json; without it that page is not tested
PICTURES  the folder that gets the picture of the guide; without it none is taken
"""
import pathlib
import signal
import sys
import tempfile
import unittest

from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

from world import OPERATORS, World, wait_for

ROOT, PROGRAMS, PAGE, PICTURES = None, None, None, None
setting = {}


def setUpModule():
    world = setting["world"] = World(ROOT, PROGRAMS)
    unittest.addModuleCleanup(world.close)
    world.bring_up()
    world.packages(PAGE)


class Session(unittest.TestCase):
    groups = []

    def setUp(self):
        self.world = setting["world"]
        address = self.enterContext_(self.world.session(self.groups))
        self.address = address
        profile = tempfile.TemporaryDirectory(prefix="dpslaved-chromium.")
        self.addCleanup(profile.cleanup)
        options = webdriver.ChromeOptions()
        for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking",
                     f"--user-data-dir={profile.name}"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.browser = webdriver.Chrome(options=options)
        self.addCleanup(self.browser.quit)

    def enterContext_(self, manager):  # unittest has it from Python 3.11 on
        value = manager.__enter__()
        self.addCleanup(manager.__exit__, None, None, None)
        return value

    def open(self, path="dpslaved/index.html"):
        self.browser.get(self.address + path)

    def text(self, place):
        return self.browser.find_element(By.CSS_SELECTOR, place).text

    def sees(self, place, *words):
        """`place` shows all of `words`, now or soon."""
        try:
            wait_for(lambda: all(word in self.text(place) for word in words), words)
        except AssertionError:
            self.fail(f"{place} does not show {words} but: {self.text(place)!r}; console: {self.complaints()}")

    def complaints(self):
        return [one["message"] for one in self.browser.get_log("browser") if one["level"] == "SEVERE"]

    def press(self, name):
        self.browser.find_element(By.ID, name).click()

    def press_until(self, name, word):
        """A busy machine tears an answer of the simulated drive now and then: the same again."""
        def answered():
            self.press(name)
            if name == "write":
                self.agree("Write")
            wait_for(lambda: self.text("#answer") not in ("", "..."), "an answer")
            return word in self.text("#answer")

        wait_for(answered, word)

    def agree(self, *words):
        """The page asks with these words, and is told to go on."""
        self.sees("#question", *words)
        self.press("question-do")

    def choose(self, station):
        self.sees("#station", station)
        Select(self.browser.find_element(By.ID, "station")).select_by_value(station)

    def set_tec(self, name, value):
        wait_for(lambda: self.browser.find_element(By.ID, "tec").is_displayed(), "the form of the TEC OPTION")
        Select(self.browser.find_element(By.ID, "tec-name")).select_by_visible_text(name)
        self.browser.find_element(By.ID, "tec-value").send_keys(value)
        self.press("tec-set")

    def enter(self, tag, value=""):
        for name, text in (("tag", tag), ("value", value)):
            field = self.browser.find_element(By.ID, name)
            field.clear()
            field.send_keys(text)


class Looking(Session):
    """Every user may look."""

    def test_stations_values_lamps_diagnosis_and_doctor_are_shown(self):
        self.open()
        self.sees("#daemon", "19.2 kbit/s", "1 of 2 stations are in data exchange")
        self.sees("#stations", "unwinder", "Data_Exch", "answers")
        self.sees("#values", "55", "12.5", "good")
        self.sees("#stations", "red", "green")
        self.sees("#diagnosis", "Octet 1")
        wait_for(lambda: self.text("#doctor") != "", "the doctor")
        self.assertEqual(self.complaints(), [])
        if PICTURES is not None:
            self.browser.set_window_size(1000, 1100)
            self.browser.save_screenshot(str(PICTURES / "cockpit.png"))

    def test_a_changed_value_is_shown_without_a_reload(self):
        self.open()
        self.sees("#values", "12.5")
        self.world.drive.stdin.write(b"set 55 33.00\n")
        self.world.drive.stdin.flush()
        self.addCleanup(self.restore)
        self.sees("#values", "33.00")

    def test_what_is_wrong_is_said_in_the_words_of_the_doctor(self):
        self.open()
        self.sees("#stations", "answers")
        self.world.drive.send_signal(signal.SIGSTOP)
        self.addCleanup(self.world.exchanges)
        self.addCleanup(self.world.drive.send_signal, signal.SIGCONT)
        self.sees("#stations", "silent")
        wait_for(lambda: self.world.causes() and all(cause in self.text("#doctor") for cause in self.world.causes()),
                 "the causes that dpctl doctor names")
        self.sees("#doctor", "unwinder")

    def restore(self):
        self.world.drive.stdin.write(b"set 55 12.50\n")
        self.world.drive.stdin.flush()


class Restart(Session):
    """The service stops and comes back."""

    def test_the_end_of_the_daemon_is_said_and_it_is_found_again(self):
        self.open()
        self.sees("#stations", "Data_Exch")
        self.world.stop(self.world.daemon)
        self.sees("#daemon", "dpctl:")
        self.assertEqual(self.text("#values tbody"), "")
        self.world.start_daemon()
        self.world.exchanges()
        self.sees("#stations", "Data_Exch")


class TornLine(Session):
    """A line that dpctl prints is no document."""

    def test_it_is_said_and_the_page_asks_again(self):
        torn = self.world.folder / "torn"
        torn.write_text("")
        self.world.dpctl_command(f"case \"$*\" in *--follow*) [ ! -s {torn} ] || echo '{{\"bus\": tor' ;; esac")
        self.addCleanup(self.world.dpctl_command)
        self.open()
        self.sees("#stations", "Data_Exch")
        torn.write_text("torn")
        self.browser.refresh()
        self.sees("#daemon", "no document")
        torn.write_text("")
        self.sees("#stations", "Data_Exch")
        self.assertEqual(self.complaints(), [])


class WithoutRights(Session):
    def test_an_input_of_the_tec_option_is_not_set(self):
        self.open()
        self.choose("winder")
        self.set_tec("RIDE THROUGH", "2")
        self.sees("#answer", "dpctl: only root and members of the group")

    def test_the_refusal_of_dpctl_is_shown_as_its_sentence(self):
        self.open()
        self.sees("#stations", "Data_Exch")
        self.enter("62", "7.7")
        self.press("write")
        self.agree("Write 7.7 to tag 62 of unwinder?")
        self.sees("#answer", "dpctl: only root and members of the group")
        self.assertIn("trouble", self.browser.find_element(By.ID, "answer").get_attribute("class"))
        self.assertNotIn("tag 62 written 7.7", self.world.said("drive"))
        self.press("reload")
        self.sees("#answer", "dpctl: only root and members of the group")

    def test_a_tag_can_be_read(self):
        self.open()
        self.sees("#stations", "Data_Exch")
        self.enter("62")
        self.press_until("read", "unwinder: tag 62")


class Operator(Session):
    groups = [OPERATORS]

    def test_a_tag_is_written_to_the_drive(self):
        self.open()
        self.sees("#stations", "Data_Exch")
        self.enter("62", "9.5")
        self.press_until("write", "9.5")
        wait_for(lambda: "tag 62 written" in self.world.said("drive"), "the drive has it")

    def test_a_write_that_is_not_agreed_to_is_not_done(self):
        self.open()
        self.sees("#stations", "Data_Exch")
        self.enter("62", "8.25")
        self.press("write")
        self.sees("#question", "Write 8.25 to tag 62 of unwinder?")
        self.browser.switch_to.active_element.send_keys(Keys.ENTER)  # the focus is on Cancel
        wait_for(lambda: not self.browser.find_element(By.ID, "question").is_displayed(), "the question is gone")
        self.press_until("read", "unwinder: tag 62")  # which comes after a write, had there been one
        self.assertNotIn("tag 62 written 8.25", self.world.said("drive"))

    def test_the_enter_key_in_the_fields_reads_and_does_not_write(self):
        self.open()
        self.sees("#stations", "Data_Exch")
        self.enter("62", "8.75")
        self.browser.find_element(By.ID, "value").send_keys(Keys.ENTER)
        wait_for(lambda: self.text("#answer") not in ("", "..."), "an answer")
        self.assertFalse(self.browser.find_element(By.ID, "question").is_displayed())
        self.assertNotIn("tag 62 written 8.75", self.world.said("drive"))

    def test_an_input_of_the_tec_option_is_set(self):
        self.open()
        self.choose("winder")
        self.set_tec("UNUSED 1", "1234")
        wait_for(lambda: self.world.tec("winder", "UNUSED 1") == 1234, "the input")

    def test_only_a_technology_box_has_the_form_of_the_tec_option(self):
        self.open()
        self.choose("winder")
        self.choose("unwinder")
        wait_for(lambda: not self.browser.find_element(By.ID, "tec").is_displayed(), "no form")

    def test_a_search_that_stops_the_requests_to_other_drives_needs_consent(self):
        self.world.exchanges()  # a search before this one may have ended it
        self.open()
        self.choose("winder")
        self.press("probe")
        self.sees("#answer", "unwinder", "add --yes")

    def test_a_search_shows_at_once_how_long_it_may_take(self):
        self.open()
        self.choose("winder")
        self.press("yes")
        self.press("probe")
        self.sees("#answer", "searching for the drive of winder", "at most")
        self.assertFalse(self.browser.find_element(By.ID, "yes").is_selected(), "the consent is for one command")

    def test_what_the_drive_refuses_is_shown(self):
        self.open()
        self.sees("#stations", "Data_Exch")
        self.enter("55", "1")
        self.press("write")
        self.agree("Write 1 to tag 55 of unwinder?")
        self.sees("#answer", "dpctl:")

    def test_the_configuration_is_read_again(self):
        self.open()
        self.sees("#stations", "Data_Exch")
        self.press("reload")
        self.agree("Reload the configuration?", "no station leaves the bus")
        wait_for(lambda: self.text("#answer") not in ("", "..."), "an answer")
        self.assertEqual(self.browser.find_element(By.ID, "answer").get_attribute("class"), "")


class Configurator(Session):
    def setUp(self):
        if PAGE is None:
            self.skipTest("no page was given")
        super().setUp()

    def test_it_starts_in_cockpit(self):
        self.open()
        self.sees("#configurator", "Open the configurator")
        self.open("dpslaved-configurator/configurator.html")
        wait_for(lambda: "being loaded" not in self.text("body"), "the page")
        self.assertIn("EURO2400", self.browser.find_element(By.TAG_NAME, "body").get_attribute("innerHTML"))
        self.assertEqual(self.complaints(), [])


def main():
    global ROOT, PROGRAMS, PAGE, PICTURES
    if not 3 <= len(sys.argv) <= 5:
        print(__doc__, file=sys.stderr)
        return 2
    places = [pathlib.Path(word).resolve() for word in sys.argv[1:]]
    ROOT, PROGRAMS, PAGE, PICTURES = places + [None] * (4 - len(places))
    return 0 if unittest.main(argv=sys.argv[:1], exit=False, verbosity=2).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
