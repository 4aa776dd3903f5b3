(** * Theorem B: the order of a symplectic pair

    The pair has the order n = 2k + 1 or 2k + 2 if and only if B(n),
      C(k) and D(k) hold on every block
    of the method, and for n = 2k + 2 the even condition. *)

From Coq Require Import QArith List Arith Lia Bool.
From Gark Require Import Stages Trees Methods Sums Check Pairs.
From Gark Require Import Products Conditions Sufficient Weights Definite Positive Lemma0.
Import ListNotations.
Open Scope Q_scope.

(** The blocks are a table: a row for each space, an entry for each colour. *)
Definition is_table (M : method) :=
  length (blocks M) = length (spaces M) /\ (forall r, In r (blocks M) -> length r = N M).

Section Pair.
Variable M : method.
Variable others : list (list (option (list (list number)))).
(** The conjugate has the field, spaces and colours of the method. *)
Let hat := {| field := field M; spaces := spaces M; colours := colours M; blocks := others |}.
Hypothesis conjugate : is_conjugate M hat.
Variable c : nat -> V.

(** ** The pair as a method: colours l and N + l share rows *)

Hypothesis M_table : is_table M.
Hypothesis hat_table : is_table hat.
Let pair := pair_of M hat.
Let n := N M.
Definition colour L := if Nat.ltb L n then L else (L - n)%nat.

Lemma N_of_pair : N pair = (n + n)%nat.
Proof. unfold N, pair, pair_of. simpl. rewrite app_length. reflexivity. Qed.
Lemma colour_of_pair L : (L < N pair)%nat -> (colour L < n)%nat.
Proof. rewrite N_of_pair. unfold colour. destruct (Nat.ltb_spec L n); lia. Qed.
Lemma colour_below_n l : (l < n)%nat -> colour l = l.
Proof. intros H. unfold colour. apply Nat.ltb_lt in H. rewrite H. reflexivity. Qed.
Lemma colour_above l : colour (n + l) = l.
Proof. unfold colour. destruct (Nat.ltb_spec (n + l) n); lia. Qed.

Lemma nth_colours L x : (L < N pair)%nat -> nth L (colours pair) x = nth (colour L) (colours M) x.
Proof.
  intros H. pose proof (colour_of_pair L H). unfold colour, pair, pair_of in *. simpl.
  destruct (Nat.ltb_spec L n); [rewrite app_nth1 by assumption|rewrite app_nth2 by assumption];
    reflexivity.
Qed.
Lemma space_of_pair L : (L < N pair)%nat -> space_of pair L = space_of M (colour L).
Proof. intros H. unfold space_of. rewrite nth_colours by exact H. reflexivity. Qed.
Lemma b_of_pair L e : (L < N pair)%nat -> b pair L e = b M (colour L) e.
Proof. intros H. unfold b, weights. rewrite nth_colours by exact H. reflexivity. Qed.
Lemma Pof_pair L : (L < N pair)%nat -> Pof pair L = Pof M (colour L).
Proof. intros H. unfold Pof. rewrite space_of_pair by exact H. reflexivity. Qed.
Lemma one_of_pair L : (L < N pair)%nat -> oneof pair L = oneof M (colour L).
Proof. intros H. unfold oneof. rewrite space_of_pair by exact H. reflexivity. Qed.
Lemma dim_of_pair L : (L < N pair)%nat -> dim pair L = dim M (colour L).
Proof. intros H. unfold dim, space_at. rewrite space_of_pair by exact H. reflexivity. Qed.

Lemma block_of_pair s L : (L < N pair)%nat ->
  block pair s L = if Nat.ltb L n then block M s L else block hat s (colour L).
Proof.
  intros H. rewrite N_of_pair in H. unfold block, pair, pair_of. simpl blocks.
  destruct M_table as [Ls Lr]. destruct hat_table as [Ls' Lr']. simpl in Ls', Lr'.
  change (N hat) with n in Lr'.
  set (f := fun '(r, s) => r ++ s).
  assert (E : nth s (map f (combine (blocks M) others)) [] = nth s (blocks M)
    [] ++ nth s others []).
  { change (@nil (option (list (list number)))) with (f ([], [])) at 1. rewrite map_nth.
    rewrite combine_nth by congruence. reflexivity. }
  rewrite E. unfold colour. destruct (nth_in_or_default s (blocks M) []) as [I|I].
  - specialize (Lr _ I). fold n in Lr. destruct (Nat.ltb_spec L n).
    + rewrite app_nth1 by lia. reflexivity.
    + rewrite app_nth2 by lia. rewrite Lr. reflexivity.
  - assert (I' : nth s others [] = []).
    { apply nth_overflow. destruct (le_lt_dec (length others) s) as [K|K]; [exact K|exfalso].
      assert (J : (s < length (blocks M))%nat) by congruence.
      specialize (Lr _ (nth_In _ [] J)). rewrite I in Lr. simpl in Lr. fold n in Lr. lia. }
    assert (Z : forall i, nth i (@nil (option (list (list number)))) None = None) by (intros [|i];
      reflexivity).
    rewrite I, I', !Z. destruct (Nat.ltb L n); reflexivity.
Qed.

(** The method to which the edges towards colour K of the pair belong. *)
Definition side K := if Nat.ltb K n then M else hat.
Lemma Aof_pair L K : (L < N pair)%nat -> (K < N pair)%nat ->
  Aof pair L K = Aof (side K) (colour L) (colour K).
Proof.
  intros H J. unfold Aof, rows, side. rewrite space_of_pair, block_of_pair by assumption.
  destruct (Nat.ltb_spec K n) as [T|T]; [rewrite (colour_below_n K T)|]; reflexivity.
Qed.
Lemma sees_pair L K : (L < N pair)%nat -> (K < N pair)%nat ->
  sees pair L K <-> sees (side K) (colour L) (colour K).
Proof.
  intros H J. unfold sees, side. rewrite space_of_pair, block_of_pair by assumption.
  destruct (Nat.ltb_spec K n) as [T|T]; [rewrite (colour_below_n K T)|]; reflexivity.
Qed.

(** The nodes of the pair: V^l and F^l share them. *)
Definition shared L := c (colour L).
Lemma power_of_pair L j : (L < N pair)%nat -> power_of pair shared L j = power_of M c (colour L) j.
Proof.
  intros H. induction j; simpl; [apply one_of_pair, H|]. rewrite IHj, Pof_pair by exact H.
  reflexivity.
Qed.

Lemma B_of_pair L k : (L < N pair)%nat -> (B pair shared L k <-> B M c (colour L) k).
Proof.
  intros H. unfold B, quadrature. change (degree pair) with (degree M).
  split; intros K j Hj e He; specialize (K j Hj e He);
    rewrite b_of_pair, power_of_pair in * by exact H; exact K.
Qed.
Lemma C_of_pair L K k : (L < N pair)%nat -> (K < N pair)%nat ->
  (C pair shared L K k <-> C (side K) c (colour L) (colour K) k).
Proof.
  intros HL HK. assert (E : forall a j, power_of (side K) c a j = power_of M c a j)
    by (intros; unfold side; destruct (Nat.ltb K n); [reflexivity|apply same_powers]).
  assert (F : dim (side K) (colour L) = dim M (colour L)) by (unfold side; destruct (Nat.ltb K n);
    reflexivity).
  unfold C, same. rewrite (Aof_pair L K HL HK), (dim_of_pair L HL), F.
  split; intros H j Hj i Hi; specialize (H j Hj i Hi);
    rewrite !E, !power_of_pair in * by assumption; exact H.
Qed.
Lemma D_of_pair L K k : (L < N pair)%nat -> (K < N pair)%nat ->
  (D pair shared L K k <-> D (side K) c (colour L) (colour K) k).
Proof.
  intros HL HK. assert (E : forall a j, power_of (side K) c a j = power_of M c a j)
    by (intros; unfold side; destruct (Nat.ltb K n); [reflexivity|apply same_powers]).
  unfold D. change (degree pair) with (degree M).
  replace (degree (side K)) with (degree M) by (unfold side; destruct (Nat.ltb K n); reflexivity).
  replace (b (side K)) with (b M) by (unfold side; destruct (Nat.ltb K n); reflexivity).
  replace (Pof (side K)) with (Pof M) by (unfold side; destruct (Nat.ltb K n); reflexivity).
  rewrite (Aof_pair L K HL HK), !Pof_pair by assumption.
  split; intros H j g e Hj He; specialize (H j g e Hj He);
    rewrite !E, !power_of_pair, !b_of_pair in * by assumption; exact H.
Qed.
Lemma even_of_pair L K k : (L < N pair)%nat -> (K < N pair)%nat ->
  (even pair shared L K k <-> even (side K) c (colour L) (colour K) k).
Proof.
  intros HL HK. assert (E : forall a j, power_of (side K) c a j = power_of M c a j)
    by (intros; unfold side; destruct (Nat.ltb K n); [reflexivity|apply same_powers]).
  unfold even, quadrature. change (degree pair) with (degree M).
  replace (degree (side K)) with (degree M) by (unfold side; destruct (Nat.ltb K n); reflexivity).
  replace (b (side K)) with (b M) by (unfold side; destruct (Nat.ltb K n); reflexivity).
  replace (Pof (side K)) with (Pof M) by (unfold side; destruct (Nat.ltb K n); reflexivity).
  rewrite (Aof_pair L K HL HK), !Pof_pair by assumption.
  split; intros H e He; specialize (H e He);
    rewrite !E, !power_of_pair, !b_of_pair in * by assumption; exact H.
Qed.

Lemma sees_hat l m : (l < n)%nat -> (m < n)%nat -> (sees hat l m <-> sees M m l).
Proof. intros Hl Hm. apply conjugate; assumption. Qed.
Lemma of_M l m : (l < n)%nat -> (m < n)%nat -> sees M l m -> sees pair l m.
Proof.
  intros Hl Hm Hs. apply sees_pair; rewrite ?N_of_pair; try lia.
  unfold side. rewrite !colour_below_n by assumption. apply Nat.ltb_lt in Hm. rewrite Hm. exact Hs.
Qed.
Lemma of_hat l m : (l < n)%nat -> (m < n)%nat -> sees hat l m -> sees pair l (n + m).
Proof.
  intros Hl Hm Hs. apply sees_pair; rewrite ?N_of_pair; try lia.
  unfold side. rewrite colour_above, colour_below_n by assumption.
  destruct (Nat.ltb_spec (n + m) n); [lia|]. exact Hs.
Qed.

Lemma shared_row_sums : (forall l, (l < n)%nat -> exists m, (m < n)%nat /\
    (sees M l m /\ same M l (c l) (app (Aof M l m) (oneof M m)) \/
     sees hat l m /\ same M l (c l) (app (Aof hat l m) (oneof M m)))) ->
  nodes_are_row_sums pair shared.
Proof.
  intros H L HL. destruct (H (colour L) (colour_of_pair L HL)) as [m [Hm K]].
  assert (HM : (m < N pair)%nat) by (rewrite N_of_pair; lia).
  assert (HM' : (n + m < N pair)%nat) by (rewrite N_of_pair; lia).
  assert (S1 : side m = M) by (unfold side; apply Nat.ltb_lt in Hm; rewrite Hm; reflexivity).
  assert (S2 : side (n + m) = hat) by (unfold side; destruct (Nat.ltb_spec (n + m) n);
    [lia|reflexivity]).
  destruct K as [[Hs Hc]|[Hs Hc]].
  - exists m. split; [exact HM|]. rewrite sees_pair, Aof_pair, S1, one_of_pair,
    (colour_below_n m Hm) by assumption.
    split; [exact Hs|]. unfold same, shared. rewrite dim_of_pair by exact HL. exact Hc.
  - exists (n + m)%nat. split; [exact HM'|].
  rewrite sees_pair, Aof_pair, S2, one_of_pair, (colour_above m) by assumption.
    split; [exact Hs|]. unfold same, shared. rewrite dim_of_pair by exact HL. exact Hc.
Qed.

(** ** Theorem B *)

Variable k p : nat.

(** B(p), C(k), D(k) and the even condition on the blocks of the method give the pair the order p.
*)
Theorem pair_if : nondegenerate M -> (p = 2 * k + 1 \/ p = 2 * k + 2)%nat ->
  criterion M c k p -> has_order pair p.
Proof.
  intros Non Hp [HB [HCD He]].
  assert (B' : forall j, (j <= p)%nat -> every_colour M (fun l => B M c l j)).
  { intros j Hj l Hl i Hi. apply (HB l Hl). lia. }
  apply (criterion_is_sufficient pair shared k p).
  - lia.
  - intros L HL. apply B_of_pair, HB, colour_of_pair; exact HL.
  - intros L K HL HK Hs. apply C_of_pair; try assumption. apply sees_pair in Hs; try assumption.
    pose proof (colour_of_pair L HL) as Hl. pose proof (colour_of_pair K HK) as Hm.
    revert Hs. unfold side. destruct (Nat.ltb K n); intros Hs; [apply HCD; assumption|].
    apply sees_hat in Hs; try assumption.
    apply lemma_0_C_of_conjugate; try assumption; [apply B'; [lia|exact Hm]|apply HCD; assumption].
  - intros L K HL HK Hs. apply D_of_pair; try assumption. apply sees_pair in Hs; try assumption.
    pose proof (colour_of_pair L HL) as Hl. pose proof (colour_of_pair K HK) as Hm.
    revert Hs. unfold side. destruct (Nat.ltb K n); intros Hs; [apply HCD; assumption|].
    apply sees_hat in Hs; try assumption.
    apply lemma_0_D_of_conjugate; try assumption; [apply B'; [lia|exact Hl]|apply HCD; assumption].
  - intros E L K HL HK Hs. apply even_of_pair; try assumption.
  apply sees_pair in Hs; try assumption.
    pose proof (colour_of_pair L HL) as Hl. pose proof (colour_of_pair K HK) as Hm.
    revert Hs. unfold side. destruct (Nat.ltb K n); intros Hs; [apply He; assumption|].
    apply sees_hat in Hs; try assumption.
    apply lemma_0_even; try assumption; [apply B'; [lia|exact Hl]|apply B'; [lia|exact Hm]|].
    apply He; assumption.
Qed.

Lemma definite_pair : definite M -> definite pair.
Proof.
  intros H L HL v K. unfold same. rewrite dim_of_pair by exact HL.
  apply (H _ (colour_of_pair L HL)). intros e He. rewrite <- b_of_pair, <- Pof_pair by exact HL.
  apply K, He.
Qed.

Theorem pair_only_if : definite M -> nodes_are_row_sums pair shared ->
  (p = 2 * k + 1 \/ p = 2 * k + 2)%nat -> has_order pair p -> criterion M c k p.
Proof.
  intros Def Rows Hp Order.
  assert (Low : has_order pair (2 * k + 1)) by (intros t Ht; apply Order; lia).
  pose proof (theorem_A pair shared k (definite_pair Def) Rows Low) as HC.
  pose proof (B_of_order pair shared Rows p Order) as HB.
  assert (HB' : every_colour M (fun l => B M c l p)).
  { intros l Hl. fold n in Hl. assert (HL : (l < N pair)%nat) by (rewrite N_of_pair; lia).
    specialize (HB l HL). apply B_of_pair in HB; [|exact HL].
    rewrite colour_below_n in HB by exact Hl. exact HB. }
  split; [exact HB'|]. split.
  - intros l m Hl Hm Hs. fold n in Hl, Hm.
    assert (HL : (l < N pair)%nat) by (rewrite N_of_pair; lia).
    assert (HM : (m < N pair)%nat) by (rewrite N_of_pair; lia).
    assert (HL' : (n + l < N pair)%nat) by (rewrite N_of_pair; lia).
    split.
    + pose proof (HC l m HL HM (of_M l m Hl Hm Hs)) as K. apply C_of_pair in K; try assumption.
      rewrite !colour_below_n in K by assumption. unfold side in K. apply Nat.ltb_lt in Hm.
      rewrite Hm in K. exact K.
    + apply (proj1 (lemma_0_of_method M others c m l k conjugate Hm Hl Hs)).
      * intros j Hj. apply (HB' l Hl). lia.
      * pose proof (HC m (n + l)%nat HM HL' (of_hat m l Hm Hl (proj2 (sees_hat m l Hm Hl) Hs)))
        as K.
        apply C_of_pair in K; try assumption.
        rewrite colour_above, colour_below_n in K by assumption.
        unfold side in K. destruct (Nat.ltb_spec (n + l) n); [lia|]. exact K.
  - intros E l m Hl Hm Hs. fold n in Hl, Hm.
    assert (HL : (l < N pair)%nat) by (rewrite N_of_pair; lia).
    assert (HM : (m < N pair)%nat) by (rewrite N_of_pair; lia).
    pose proof (even_of_order pair shared Rows p Order k ltac:(lia) l m HL HM (of_M l m Hl Hm Hs))
      as K.
    apply even_of_pair in K; try assumption.
    rewrite !colour_below_n in K by assumption. unfold side in K. apply Nat.ltb_lt in Hm.
    rewrite Hm in K. exact K.
Qed.
End Pair.

(** ** For readers *)

(** The nodes of a colour are the row sums of one of its blocks,
  of the method or of its conjugate. *)
Definition nodes_of_pair M hat c := every_colour M (fun l => exists m, (m < N M)%nat /\
  (sees M l m /\ same M l (c l) (app (Aof M l m) (oneof M m)) \/
   sees hat l m /\ same M l (c l) (app (Aof hat l m) (oneof M m)))).

Section Readers.
Variables M hat : method.
Variable c : nat -> V.
Variables k n : nat.
Hypothesis conjugate : is_conjugate M hat.
Hypothesis tables : is_table M /\ is_table hat.
Hypothesis n_is : (n = 2 * k + 1 \/ n = 2 * k + 2)%nat.

Theorem theorem_B_if : nondegenerate M -> criterion M c k n -> has_order (pair_of M hat) n.
Proof.
  intros Non Has.
  destruct tables as [T T'], hat as [f s cs others], conjugate as [E1 [E2 [E3 H]]].
  simpl in E1, E2, E3. subst f s cs.
  exact (pair_if M others conjugate c T T' k n Non n_is Has).
Qed.

Theorem theorem_B : definite M -> nodes_of_pair M hat c ->
  (has_order (pair_of M hat) n <-> criterion M c k n).
Proof.
  intros Def Nodes. split; [|apply theorem_B_if, definite_is_nondegenerate, Def].
  clear - conjugate tables n_is Def Nodes.
  destruct tables as [T T'], hat as [f s cs others], conjugate as [E1 [E2 [E3 H]]].
  simpl in E1, E2, E3. subst f s cs.
  apply (pair_only_if M others conjugate c T T' k n Def); [|exact n_is].
  apply shared_row_sums; assumption.
Qed.

(** Stages at points. *)
Corollary theorem_B_if_with_nonzero_weights : at_points M -> degree M = 1%nat ->
  nonzero_weights M -> criterion M c k n -> has_order (pair_of M hat) n.
Proof. intros P R W. apply theorem_B_if, nonzero_is_nondegenerate; assumption. Qed.
Corollary theorem_B_with_positive_weights positive : at_points M -> ordering M positive ->
  positive_weights M positive -> nodes_of_pair M hat c ->
  (has_order (pair_of M hat) n <-> criterion M c k n).
Proof. intros P O W. apply theorem_B, positive_is_definite with positive; assumption. Qed.
End Readers.

(** ** For a method as data: the hypotheses by computation *)

(** c = A^{l,l} 𝟙. *)
Definition row_sums M l := app (Aof M l l) (oneof M l).

Definition theorem_B_applies M hat lambda : bool :=
  forallb (fun T => Nat.eqb (length (blocks T)) (length (spaces T)) &&
    forallb (fun r => Nat.eqb (length r) (N T)) (blocks T)) [M; hat] &&
  all (N M) (fun l => is_seen M l l) && definite_by_elimination M lambda.

Theorem theorem_B_for M hat lambda k n : theorem_B_applies M hat lambda = true ->
  is_conjugate M hat -> (n = 2 * k + 1 \/ n = 2 * k + 2)%nat ->
  (has_order (pair_of M hat) n <-> criterion M (row_sums M) k n).
Proof.
  intros H Con Hn. unfold theorem_B_applies in H. rewrite !andb_true_iff in H.
  destruct H as [[T Seen] Def]. rewrite forallb_forall in T.
  assert (Tables : forall X, In X [M; hat] -> is_table X).
  { intros X I. specialize (T X I). rewrite andb_true_iff, Nat.eqb_eq, forallb_forall in T.
    split; [apply T|]. intros r Hr. apply Nat.eqb_eq, T, Hr. }
  apply theorem_B; try assumption.
  - split; apply Tables; simpl; auto.
  - apply definite_by with (1 := Def).
  - intros l Hl. exists l. split; [exact Hl|]. left. split; [|intros i _; reflexivity].
    apply seen_iff, (all_at _ _ Seen l Hl).
Qed.

Print Assumptions theorem_B_if.
Print Assumptions theorem_B.
Print Assumptions theorem_B_for.
