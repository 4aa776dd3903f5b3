(** * The checker, which computes with whole numbers, and why what it accepts is true *)

From Coq Require Import QArith ZArith List Arith Lia Bool.
From Gark Require Import Stages Trees Methods.
Import ListNotations.
Open Scope Q_scope.

(** ** Vectors and coefficients with one denominator *)

Definition zvec := (list Z * positive)%type.
Definition val (x : zvec) : V := fun i => nth i (fst x) 0%Z # snd x.

Fixpoint zlin (ts : list (nat * Z)) (x : list Z) : Z :=
  match ts with [] => 0%Z | (j, q) :: r => (q * nth j x 0 + zlin r x)%Z end.
Fixpoint zbil (ts : list (nat * nat * Z)) (x y : list Z) : Z :=
  match ts with [] => 0%Z | (a, c, q) :: r => (q * nth a x 0 * nth c y 0 + zbil r x y)%Z end.

Definition common (qs : list Q) : positive :=
  fold_right (fun q d => Z.to_pos (Z.lcm (Zpos (Qden q)) (Zpos d))) 1%positive qs.
Definition whole (D : positive) (q : Q) : Z := (Qnum q * (Zpos D / Zpos (Qden q)))%Z.
Definition scaled {X} D (ts : list (X * Q)) : list (X * Z) :=
  map (fun t => (fst t, whole D (snd t))) ts.
Definition is_scaled {X} D (ts : list (X * Q)) : bool :=
  forallb (fun t => Qeq_bool (snd t) (whole D (snd t) # D)) ts.

Lemma same_denominator a b d : (a # d) + (b # d) == (a + b)%Z # d.
Proof. unfold Qeq, Qplus; simpl. rewrite Pos2Z.inj_mul. ring. Qed.

Lemma zlin_val D ts x : is_scaled D ts = true ->
  lin ts (val x) == zlin (scaled D ts) (fst x) # (D * snd x).
Proof.
  induction ts as [|[j q] r IH]; simpl; intros H; [reflexivity|].
  apply andb_prop in H. destruct H as [H K]. rewrite (IH K), <- same_denominator.
  apply Qeq_bool_iff in H. simpl in H. rewrite H at 1. reflexivity.
Qed.

Lemma zbil_val D ts x y : is_scaled D ts = true ->
  bil ts (val x) (val y) == zbil (scaled D ts) (fst x) (fst y) # (D * snd x * snd y).
Proof.
  induction ts as [|[[a c] q] r IH]; simpl; intros H; [reflexivity|].
  apply andb_prop in H. destruct H as [H K]. rewrite (IH K), <- same_denominator.
  apply Qeq_bool_iff in H. simpl in H. rewrite H at 1. reflexivity.
Qed.

(** A matrix or a product, row after row. *)
Definition ztable X := (positive * list (list (X * Z)))%type.
Definition zt {X} (rs : list (list (X * Q))) : ztable X :=
  let D := common (map snd (concat rs)) in (D, map (scaled D) rs).
Definition is_zt {X} (rs : list (list (X * Q))) : bool :=
  forallb (is_scaled (common (map snd (concat rs)))) rs.

Definition zapp (A : ztable nat) (x : zvec) : zvec :=
  (map (fun ts => zlin ts (fst x)) (snd A), fst A * snd x)%positive.
Definition zmul (P : ztable (nat * nat)) (x y : zvec) : zvec :=
  (map (fun ts => zbil ts (fst x) (fst y)) (snd P), fst P * snd x * snd y)%positive.
Definition zscale (n : nat) (x : zvec) : zvec :=
  (map (Z.mul (Z.of_nat n)) (fst x), snd x).

Lemma row_is_scaled {X} (rs : list (list (X * Q))) i : is_zt rs = true ->
  is_scaled (fst (zt rs)) (nth i rs []) = true.
Proof.
  intros H. unfold is_zt in H. rewrite forallb_forall in H.
  destruct (nth_in_or_default i rs []) as [K|K]; [apply H, K|rewrite K; reflexivity].
Qed.

Lemma zapp_val rs x : is_zt rs = true ->
  veq (val (zapp (zt rs) x)) (app (fun i => nth i rs []) (val x)).
Proof.
  intros H i. unfold val at 1, app. simpl fst. simpl snd.
  rewrite (zlin_val (fst (zt rs)) _ x (row_is_scaled rs i H)). simpl fst.
  rewrite map_map. change 0%Z with ((fun ts => zlin (scaled (common (map snd (concat rs))) ts) (fst x)) []).
  rewrite map_nth. reflexivity.
Qed.

Lemma zmul_val rs x y : is_zt rs = true ->
  veq (val (zmul (zt rs) x y)) (mul (fun i => nth i rs []) (val x) (val y)).
Proof.
  intros H i. unfold val at 1, mul. simpl fst. simpl snd.
  rewrite (zbil_val (fst (zt rs)) _ x y (row_is_scaled rs i H)). simpl fst.
  rewrite map_map.
  change 0%Z with ((fun ts => zbil (scaled (common (map snd (concat rs))) ts) (fst x) (fst y)) []).
  rewrite map_nth. reflexivity.
Qed.

Lemma zscale_val n x : veq (val (zscale n x)) (scale (inject_Z (Z.of_nat n)) (val x)).
Proof.
  intros i. unfold val, scale, zscale. simpl fst. simpl snd.
  replace (nth i (map (Z.mul (Z.of_nat n)) (fst x)) 0%Z) with (Z.of_nat n * nth i (fst x) 0)%Z.
  - unfold Qeq; simpl. reflexivity.
  - rewrite <- map_nth with (f := Z.mul (Z.of_nat n)). rewrite Z.mul_0_r. reflexivity.
Qed.

(** ** Affine hulls: a point, and directions, each with an entry by whose value it is taken *)

Record zhull := { den : positive; base : list Z; dirs : list (nat * list Z) }.

Fixpoint zadd (xs ys : list Z) : list Z :=
  match xs, ys with
  | [], _ => ys
  | _, [] => xs
  | x :: xs, y :: ys => (x + y)%Z :: zadd xs ys
  end.

Lemma nth_zadd i : forall xs ys, nth i (zadd xs ys) 0%Z = (nth i xs 0 + nth i ys 0)%Z.
Proof.
  induction i; intros [|x xs] [|y ys]; simpl; rewrite ?Z.add_0_r; try reflexivity. apply IHi.
Qed.

Definition zpoints_of (H : zhull) : list zvec :=
  (base H, den H) :: map (fun r => (zadd (base H) (snd r), den H)) (dirs H).
Definition zpoints (H : option zhull) := match H with None => [] | Some H => zpoints_of H end.
Definition points H := map val (zpoints H).

Fixpoint zcomb (v : list Z) (rs : list (nat * list Z)) (i : nat) : Z :=
  match rs with [] => 0%Z | (pivot, r) :: rs => (nth pivot v 0 * nth i r 0 + zcomb v rs i)%Z end.

Definition longest (H : zhull) (v : zvec) : nat :=
  fold_right Nat.max (Nat.max (length (fst v)) (length (base H)))
    (map (fun r => length (snd r)) (dirs H)).

Definition is_in (H : zhull) (v : zvec) : bool :=
  forallb (fun i => Z.eqb (nth i (fst v) 0 * Zpos (den H))%Z
                          (nth i (base H) 0 * Zpos (snd v) + zcomb (fst v) (dirs H) i)%Z)
    (seq 0 (longest H v)).
Definition in_zhull (H : option zhull) v := match H with None => false | Some H => is_in H v end.

Fixpoint comb d (v : V) (rs : list (nat * list Z)) : V :=
  match rs with
  | [] => fun _ => 0
  | (pivot, r) :: rs => add (scale (v pivot) (val (r, d))) (comb d v rs)
  end.

Lemma comb_val d v rs i :
  comb d (val v) rs i == zcomb (fst v) rs i # (snd v * d).
Proof.
  induction rs as [|[pivot r] rs IH]; simpl; [reflexivity|].
  unfold add, scale. rewrite IH, <- same_denominator. reflexivity.
Qed.

Lemma max_le n : forall ns m, (fold_right Nat.max m ns <= n)%nat ->
  (m <= n)%nat /\ forall k, In k ns -> (k <= n)%nat.
Proof.
  induction ns as [|a ns IH]; simpl; intros m H; [split; [assumption|contradiction]|].
  destruct (IH m ltac:(lia)) as [I J]. split; [assumption|].
  intros k [->|K]; [lia|apply J, K].
Qed.

Lemma is_in_all H v : is_in H v = true -> forall i,
  (nth i (fst v) 0 * Zpos (den H) = nth i (base H) 0 * Zpos (snd v) + zcomb (fst v) (dirs H) i)%Z.
Proof.
  intros K i. unfold is_in in K. rewrite forallb_forall in K.
  destruct (lt_dec i (longest H v)) as [L|L].
  - apply Z.eqb_eq, K, in_seq. lia.
  - unfold longest in L. apply Nat.nlt_ge, max_le in L. destruct L as [L J].
    rewrite (nth_overflow (fst v)), (nth_overflow (base H)) by lia.
    assert (E : zcomb (fst v) (dirs H) i = 0%Z).
    { clear K L. induction (dirs H) as [|[pivot r] rs IH]; simpl; [reflexivity|].
      rewrite IH; [|intros k Hk; apply J; right; assumption].
      rewrite (nth_overflow r); [ring|]. apply J. left. reflexivity. }
    rewrite E. ring.
Qed.

Lemma comb_zero f c d b rs v : linear f -> f (val (b, d)) == c ->
  (forall r, In r rs -> f (val (zadd b (snd r), d)) == c) -> f (comb d v rs) == 0.
Proof.
  intros L B. induction rs as [|[pivot r] rs IH]; simpl; intros K.
  - rewrite (l_ext _ L _ (scale 0 (fun _ => 0))); [rewrite (l_scale _ L); ring|].
    intros i. unfold scale. ring.
  - rewrite (l_add _ L), (l_scale _ L), IH; [|intros; apply K; right; assumption].
    assert (E : f (val (r, d)) == 0).
    { assert (S : f (val (zadd b r, d)) == f (val (b, d)) + f (val (r, d))).
      { rewrite <- (l_add _ L). apply (l_ext _ L). intros i. unfold add, val; simpl.
        rewrite nth_zadd, same_denominator. reflexivity. }
      rewrite (K (pivot, r) (or_introl eq_refl)), B in S. 
      setoid_replace (f (val (r, d))) with (c + f (val (r, d)) - c) by ring.
      rewrite <- S. ring. }
    rewrite E. ring.
Qed.

Lemma in_zhull_hull H v : in_zhull H v = true -> hull (points H) (val v).
Proof.
  destruct H as [H|]; [simpl|discriminate].
  intros K f c L G. assert (I := is_in_all H v K).
  assert (B : f (val (base H, den H)) == c) by (apply G; left; reflexivity).
  assert (D : forall r, In r (dirs H) -> f (val (zadd (base H) (snd r), den H)) == c).
  { intros r R. apply G. right. apply in_map, in_map_iff. exists r. split; [reflexivity|assumption]. }
  rewrite (l_ext _ L _ (add (val (base H, den H)) (comb (den H) (val v) (dirs H)))).
  - rewrite (l_add _ L), B, (comb_zero f c _ _ _ _ L B D). ring.
  - intros i. unfold add. rewrite comb_val. unfold val; simpl.
    unfold Qeq, Qplus; simpl. specialize (I i).
    rewrite !Pos2Z.inj_mul. 
    transitivity ((nth i (fst v) 0 * Zpos (den H)) * Zpos (snd v) * Zpos (den H))%Z; [ring|].
    rewrite I. ring.
Qed.

Lemma hull_ext S v w : veq v w -> hull S v -> hull S w.
Proof. intros E H f c L K. rewrite <- (l_ext _ L v w E). apply H; assumption. Qed.

(** ** The checker *)

Section Checker.
Variable M : method.
Variable p : nat.
Variable F G : list (list (option zhull)).
(* F by k = 0, …, p − 1, G by the order of a branch, both by the colour; None where no tree is *)

Definition Fof k l := nth l (nth k F []) None.
Definition Gof j l := nth l (nth j G []) None.
Definition all (n : nat) (c : nat -> bool) := forallb c (seq 0 n).
Definition table {X} (n : nat) (f : nat -> X) : list X := map f (seq 0 n).

Definition is_seen l m : bool := match block M (space_of M l) m with None => false | _ => true end.
Definition A_rows l m := rows M (space_of M l) m.
Definition P_rows l := product_of M (the_space M (space_of M l)).

Definition zone l : zvec := (map Qnum (one_of M (the_space M (space_of M l))), 1%positive).
Definition is_zone l : bool :=
  forallb (fun q => Qeq_bool q (Qnum q # 1)) (one_of M (the_space M (space_of M l))).

Definition tables_are_whole : bool :=
  all (N M) (fun l => is_zone l && is_zt (P_rows l)
    && all (N M) (fun m => is_zt (A_rows l m))
    && all (degree M) (fun e => is_zt [weights M l e])).

Definition starts_ok := all (N M) (fun l => in_zhull (Fof 0 l) (zone l)).

Definition branches_ok :=
  let A := table (N M) (fun l => table (N M) (fun m => zt (A_rows l m))) in
  all (p - 1) (fun j => all (N M) (fun l => all (N M) (fun m =>
    negb (is_seen l m) ||
    forallb (fun a => in_zhull (Gof (S j) l) (zapp (nth m (nth l A []) (1%positive, [])) (zscale (S j) a)))
      (zpoints (Fof j m))))).

Definition products_ok :=
  let P := table (N M) (fun l => zt (P_rows l)) in
  all p (fun k => all (N M) (fun l => all k (fun i =>
    forallb (fun u => forallb (fun w =>
        in_zhull (Fof k l) (zmul (nth l P (1%positive, [])) u w))
      (zpoints (Fof (k - S i) l))) (zpoints (Gof (S i) l))))).

Definition meets l e k (v : zvec) : bool :=
  let W := zt [weights M l e] in
  let x := zapp W v in
  Qeq_bool (nth 0 (fst x) 0%Z # snd x) (if Nat.eqb e 0 then 1 # Pos.of_nat (S k) else 0).
Definition conditions_ok :=
  all p (fun k => all (N M) (fun l => all (degree M) (fun e =>
    forallb (meets l e k) (zpoints (Fof k l))))).

Definition order_is_proved : bool :=
  tables_are_whole && starts_ok && branches_ok && products_ok && conditions_ok.

Lemma all_at n c : all n c = true -> forall i, (i < n)%nat -> c i = true.
Proof. intros H i Hi. unfold all in H. rewrite forallb_forall in H. apply H, in_seq. lia. Qed.

Lemma nth_table {X} n (f : nat -> X) i d : (i < n)%nat -> nth i (table n f) d = f i.
Proof.
  intros H. unfold table. rewrite nth_indep with (d' := f 0%nat) by (rewrite map_length, seq_length; exact H).
  rewrite map_nth, seq_nth by exact H. reflexivity.
Qed.

Lemma seen_iff l m : sees M l m <-> is_seen l m = true.
Proof. unfold sees, is_seen. destruct (block M (space_of M l) m); split; congruence. Qed.

Hypothesis tables : tables_are_whole = true.

Lemma tables_of l : (l < N M)%nat -> is_zone l = true /\ is_zt (P_rows l) = true /\
  (forall m, (m < N M)%nat -> is_zt (A_rows l m) = true) /\
  (forall e, (e < degree M)%nat -> is_zt [weights M l e] = true).
Proof.
  intros H. pose proof (all_at _ _ tables l H) as K.
  apply andb_prop in K. destruct K as [K W]. apply andb_prop in K. destruct K as [K A].
  apply andb_prop in K. destruct K as [Z P].
  repeat split; [assumption|assumption|intros; apply (all_at _ _ A); assumption|
                 intros; apply (all_at _ _ W); assumption].
Qed.

Lemma zone_val l : (l < N M)%nat -> veq (val (zone l)) (oneof M l).
Proof.
  intros H i. destruct (tables_of l H) as [Z _]. unfold is_zone in Z. rewrite forallb_forall in Z.
  unfold val, zone, oneof; simpl. set (os := one_of M _) in *.
  destruct (nth_in_or_default i os 0) as [K|K].
  - change 0%Z with (Qnum 0). rewrite map_nth. symmetry. apply Qeq_bool_iff, Z, K.
  - rewrite K. change 0%Z with (Qnum 0). rewrite map_nth, K. reflexivity.
Qed.

Lemma b_val l e v : (l < N M)%nat -> (e < degree M)%nat ->
  b M l e (val v) == val (zapp (zt [weights M l e]) v) 0%nat.
Proof.
  intros Hl He. destruct (tables_of l Hl) as [_ [_ [_ W]]].
  rewrite (zapp_val _ v (W e He) 0%nat). reflexivity.
Qed.

Theorem proved_order : starts_ok = true -> branches_ok = true -> products_ok = true ->
  conditions_ok = true -> has_order M p.
Proof.
  intros St Br Pr Co t Ho Ht.
  set (FF := fun k l => points (Fof k l)). set (GG := fun j l => points (Gof j l)).
  assert (H : hull (FF (order t - 1)%nat (root t)) (psi (Pof M) (Aof M) (oneof M) t)).
  { apply (trees_are_spanned (Pof M) (Aof M) (oneof M) (sees M) (N M) p FF GG);
      [| | |assumption|assumption].
    - intros l Hl. apply hull_ext with (1 := zone_val l Hl).
      apply in_zhull_hull, (all_at _ _ St l Hl).
    - intros j l m Hj Hl Hm Hs a Ha. apply in_map_iff in Ha. destruct Ha as [z [<- Hz]].
      pose proof (all_at _ _ (all_at _ _ (all_at _ _ Br j ltac:(lia)) l Hl) m Hm) as K.
      cbv zeta beta in K. rewrite (proj1 (seen_iff l m) Hs) in K. cbn [negb orb] in K.
      rewrite forallb_forall in K. specialize (K z Hz).
      rewrite (nth_table (N M) _ l _ Hl), (nth_table (N M) _ m _ Hm) in K.
      apply in_zhull_hull in K. revert K. apply hull_ext.
      intros i. destruct (tables_of l Hl) as [_ [_ [A _]]].
      rewrite (zapp_val _ _ (A m Hm) i). apply app_ext, zscale_val.
    - intros k l j Hk Hl Hj u w Hu Hw.
      apply in_map_iff in Hu. destruct Hu as [u' [<- Hu]].
      apply in_map_iff in Hw. destruct Hw as [w' [<- Hw]].
      pose proof (all_at _ _ (all_at _ _ (all_at _ _ Pr k Hk) l Hl) (j - 1)%nat ltac:(lia)) as K.
      cbv zeta beta in K. replace (S (j - 1)) with j in K by lia.
      rewrite forallb_forall in K. specialize (K u' Hu). rewrite forallb_forall in K.
      specialize (K w' Hw). rewrite (nth_table (N M) _ l _ Hl) in K.
      apply in_zhull_hull in K. revert K. apply hull_ext.
      destruct (tables_of l Hl) as [_ [P _]]. apply (zmul_val _ _ _ P). }
  assert (Hl : (root t < N M)%nat) by (apply (colour_below (sees M) (N M)), Ht).
  pose proof (order_pos t) as Op.
  intros e He. apply H; [apply lin_linear|]. intros s Hs.
  apply in_map_iff in Hs. destruct Hs as [z [<- Hz]].
  pose proof (all_at _ _ (all_at _ _ (all_at _ _ Co (order t - 1)%nat ltac:(lia)) (root t) Hl) e He) as K.
  cbv beta in K. rewrite forallb_forall in K. specialize (K z Hz). unfold meets in K.
  apply Qeq_bool_iff in K. replace (S (order t - 1)) with (order t) in K by lia.
  change (b M (root t) e (val z) == if Nat.eqb e 0 then 1 # Pos.of_nat (order t) else 0).
  rewrite (b_val _ _ _ Hl He). exact K.
Qed.

(** ** A tree that fails *)

Fixpoint zpsi t : zvec :=
  match t with Node l us =>
    (fix product us := match us with
       | [] => zone l
       | u :: r => zmul (zt (P_rows l)) (zapp (zt (A_rows l (root u))) (zscale (order u) (zpsi u)))
                        (product r)
     end) us
  end.

Fixpoint is_admissible t : bool :=
  match t with Node l us =>
    Nat.ltb l (N M) &&
    (fix each us := match us with
       | [] => true | u :: r => is_seen l (root u) && is_admissible u && each r end) us
  end.

Lemma tree_ind' (P : tree -> Prop) :
  (forall l us, (forall u, In u us -> P u) -> P (Node l us)) -> forall t, P t.
Proof.
  intros H. fix IH 1. intros [l us]. apply H.
  induction us as [|u r IHr]; [contradiction|]. intros v [<-|K]; [apply IH|apply IHr, K].
Qed.

Lemma admissible_iff t : is_admissible t = true -> is_tree M t.
Proof.
  induction t as [l us IH] using tree_ind'. unfold is_tree. simpl. intros H.
  apply andb_prop in H. destruct H as [Hl H]. split; [apply Nat.ltb_lt, Hl|].
  induction us as [|u r IHr]; [exact I|].
  apply andb_prop in H. destruct H as [H Hr]. apply andb_prop in H. destruct H as [Hs Hu].
  split; [apply seen_iff, Hs|]. split; [apply IH; [left; reflexivity|exact Hu]|].
  apply IHr; [intros v K; apply IH; right; exact K|exact Hr].
Qed.

Lemma mul_ext P x x' y y' : veq x x' -> veq y y' -> veq (mul P x y) (mul P x' y').
Proof.
  intros H K i. unfold mul. rewrite (l_ext _ (bil_left (P i) y) x x' H).
  apply (l_ext _ (bil_right (P i) x')), K.
Qed.

Lemma veq_trans x y z : veq x y -> veq y z -> veq x z.
Proof. intros H K i. rewrite (H i). apply K. Qed.

Lemma zpsi_val t : is_tree M t -> veq (val (zpsi t)) (psi (Pof M) (Aof M) (oneof M) t).
Proof.
  induction t as [l us IH] using tree_ind'. unfold is_tree. simpl. intros [Hl Hus].
  destruct (tables_of l Hl) as [_ [P [A _]]].
  induction us as [|u r IHr]; [apply zone_val, Hl|].
  destruct Hus as [Hs [Hu Hr]].
  eapply veq_trans; [apply zmul_val, P|]. apply mul_ext.
  - eapply veq_trans; [apply zapp_val, A, (colour_below (sees M) (N M)), Hu|]. apply app_ext.
    eapply veq_trans; [apply zscale_val|]. intros i. unfold scale.
    rewrite (IH u (or_introl eq_refl) Hu i). reflexivity.
  - apply IHr; [intros v K; apply IH; right; exact K|exact Hr].
Qed.

Definition fails (t : tree) : bool :=
  is_admissible t && existsb (fun e => negb (meets (root t) e (order t - 1) (zpsi t))) (seq 0 (degree M)).

Theorem proved_failure t : fails t = true -> is_tree M t /\ ~ holds M t.
Proof.
  intros H. apply andb_prop in H. destruct H as [Ha H]. apply admissible_iff in Ha.
  split; [assumption|]. intros C. apply existsb_exists in H. destruct H as [e [He H]].
  apply in_seq in He. destruct He as [_ He]. simpl in He.
  assert (Hl : (root t < N M)%nat) by (apply (colour_below (sees M) (N M)), Ha).
  apply negb_true_iff in H. assert (K : meets (root t) e (order t - 1) (zpsi t) = true); [|congruence].
  unfold meets. apply Qeq_bool_iff. pose proof (order_pos t).
  replace (S (order t - 1)) with (order t) by lia. rewrite <- (C e He).
  change (val (zapp (zt [weights M (root t) e]) (zpsi t)) 0%nat ==
          b M (root t) e (psi (Pof M) (Aof M) (oneof M) t)).
  rewrite <- (b_val _ _ _ Hl He). apply (l_ext _ (lin_linear _)), zpsi_val, Ha.
Qed.
End Checker.

(** ** What is asked of a method: its order, and that it is no higher *)

Theorem has_order_by M p F G : order_is_proved M p F G = true -> has_order M p.
Proof.
  intros H. unfold order_is_proved in H. repeat (apply andb_prop in H; destruct H as [H ?]).
  eapply proved_order; eassumption.
Qed.

Theorem not_higher_by M p t :
  tables_are_whole M && Nat.eqb (order t) (S p) && fails M t = true -> ~ has_order M (S p).
Proof.
  intros H. apply andb_prop in H. destruct H as [H K]. apply andb_prop in H. destruct H as [T O].
  apply Nat.eqb_eq in O. destruct (proved_failure M T t K) as [Ht C].
  intros G. apply C, G; [lia|assumption].
Qed.
